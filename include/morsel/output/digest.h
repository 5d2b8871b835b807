#ifndef morsel_output_digest_h
#define morsel_output_digest_h

#include <string>
#include <utility>
#include <vector>

namespace Morsel::Output
{
  /// A few numbers of a short run, for comparison with a stored reference by
  /// numdiff (absolute 1e-6, relative 1e-8): one line "name value" each.
  ///
  /// numdiff takes 1e-7 and 9e-7 as equal and nan as equal to nan. Values are
  /// therefore to be given in units that make them of order one (mm, N, ms,
  /// kPa), and what is not finite is refused.
  class Digest
  {
  public:
    /// Adds value * scale under @p name, which names the scaled unit too, as
    /// in "closure_mm".
    ///
    /// @throws NumericalError if the value is not finite.
    void
    add(const std::string &name, double value, double scale = 1.);

    /// @throws FileError with the file's name.
    void
    write(const std::string &file_name = "output") const;

  private:
    std::vector<std::pair<std::string, double>> entries;
  };
} // namespace Morsel::Output

#endif
