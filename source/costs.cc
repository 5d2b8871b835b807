#include "costs.h"

#include <morsel/core/data_files.h>
#include <morsel/core/errors.h>

#include <cmath>
#include <fstream>

namespace Morsel
{
  namespace
  {
    const char *const file_name = "recorded/costs.json";


    template <typename Read>
    double
    read(const Read &value)
    {
      try
        {
          return value();
        }
      catch (const std::exception &error)
        {
          throw FileError(std::string("The recorded costs '") + file_name +
                          "' are not understood: " + error.what());
        }
    }
  } // namespace


  Costs::Costs()
  {
    std::ifstream file(shipped_file(file_name));
    document = nlohmann::ordered_json::parse(file, nullptr, false);
  }


  double
  Costs::of(const std::string &part,
            const std::string &what,
            const Sizes       &sizes) const
  {
    return read([&] {
      double sum = 0.;
      for (const auto &term : document.at("parts").at(part).at(what))
        {
          double product = term.at("coefficient");
          for (const auto &[size, exponent] : term.at("exponents").items())
            product *= std::pow(sizes.at(size), exponent.get<double>());
          sum += product;
        }
      return sum;
    });
  }


  double
  Costs::figure(const std::string &name) const
  {
    return read([&] { return document.at("figures").at(name).get<double>(); });
  }


  double
  Costs::machine_factor(const Workload workload) const
  {
    return read([&] {
      // Once a process: a plan predicts many settings.
      static std::map<Workload, double> times;
      if (times.count(workload) == 0)
        times[workload] = measure(workload).wall;
      return times[workload] / document.at("calibration")
                                   .at("workloads")
                                   .at(name_of(workload))
                                   .at("processor_time")
                                   .get<double>();
    });
  }
} // namespace Morsel
