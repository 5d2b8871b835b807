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


  void
  Costs::predict_time(Prediction    &prediction,
                      const Workload workload,
                      const double   seconds) const
  {
    // Once a process: a plan predicts many settings.
    static std::map<Workload, Times> measured;
    if (measured.count(workload) == 0)
      measured[workload] = measure(workload);
    const Times &now   = measured[workload];
    const Times  start = start_time();
    const double then  = read([&] {
      return document.at("calibration")
          .at("workloads")
          .at(name_of(workload))
          .at("processor_time")
          .get<double>();
    });
    prediction.seconds = start.wall + seconds * now.wall / then;
    prediction.processor_seconds =
        start.processor + seconds * now.processor / then;
    prediction.basis = "recorded costs, this machine calibrated now";
  }
} // namespace Morsel
