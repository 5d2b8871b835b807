#include <morsel/core/atomic_file.h>
#include <morsel/core/errors.h>
#include <morsel/output/digest.h>

#include <cmath>
#include <sstream>

namespace Morsel::Output
{
  void
  Digest::add(const std::string &name, const double value, const double scale)
  {
    if (!std::isfinite(value * scale))
      throw NumericalError("The digest's entry '" + name +
                           "' is not a finite number.");
    entries.emplace_back(name, value * scale);
  }


  void
  Digest::write(const std::string &file_name) const
  {
    std::ostringstream content;
    content.precision(12);
    for (const auto &[name, value] : entries)
      content << name << ' ' << value << '\n';
    write_atomically(file_name, content.str());
  }
} // namespace Morsel::Output
