#include <morsel/core/machine.h>
#include <morsel/core/suggestions.h>
#include <morsel/scene/findings.h>

#include <algorithm>
#include <cmath>

namespace Morsel::Scene
{
  namespace
  {
    /// Measured: 416,000 particles that can break take 1.5 GB.
    constexpr double bytes_per_particle = 3600.;


    /// How far a lattice of n columns and the nearest number of rows is off
    /// the body's height, relative.
    double
    misfit_of_rows(const ParticleBody &body, const unsigned int n)
    {
      const double rows = body.shape.extent(1) / body.shape.extent(0) * n;
      return std::abs(std::round(rows) / rows - 1.);
    }


    /// Plates touch particles half a spacing off: rows closer than the columns
    /// would press on them from the start.
    void
    check_rows(const ParticleBody &body,
               const bool          between_plates,
               Findings           &findings)
    {
      constexpr double   tolerance = 1e-6;
      const unsigned int n         = body.particles_across;
      const double       misfit    = misfit_of_rows(body, n);
      if (!(misfit > tolerance))
        return;
      const std::string path =
          "Body " + body.name + "/Particles/Particles across";
      if (!between_plates)
        {
          findings.advise(
              path,
              "the height is not a multiple of the spacing " +
                  number_text(body.spacing) + " m; the lattice is " +
                  number_text(100. * misfit) + " % off the body's height.");
          return;
        }
      std::string example;
      for (unsigned int k = 1; k < n && example.empty(); ++k)
        for (const unsigned int other : {n + k, n - k})
          if (other > 3 && example.empty() &&
              misfit_of_rows(body, other) <= tolerance)
            example = ", for instance " + std::to_string(other);
      findings.mistake(path,
                       "the height is not a multiple of the spacing " +
                           number_text(body.spacing) +
                           " m, so that rows would press on the plates from "
                           "the start; take a number for which it is" +
                           example + ".");
    }
  } // namespace


  void
  check_particles(const ParticleBody &body,
                  const Scene        &scene,
                  Findings           &findings)
  {
    const std::string path =
        "Body " + body.name + "/Particles/Particles across";
    if (body.particles_across == 0)
      {
        findings.mistake(path,
                         "the body has no particles; give their number "
                         "along x, for instance 101.");
        return;
      }
    const unsigned int fewest =
        std::min(body.particles_across, body.particles_high());
    if (fewest < 4)
      findings.mistake(path,
                       "the body is " + std::to_string(fewest) +
                           " particles thick, too few to carry a gradient; "
                           "at least 4 are needed, 50 or more advised.");
    else if (fewest < 20)
      findings.advise(path,
                      "the body is only " + std::to_string(fewest) +
                          " particles thick; the support of a particle "
                          "spans " +
                          number_text(4. * body.solid.smoothing_ratio) +
                          " of them, so take at least 20, better 50.");

    const double count     = body.shape.area() / (body.spacing * body.spacing);
    const double gigabytes = 1e-9 * bytes_per_particle * count;
    if (count > 2e7)
      findings.mistake(path,
                       "the body would have " + number_text(count) +
                           " particles; at most 20 million are allowed.");
    else if (1e9 * gigabytes > machine_memory())
      findings.mistake(path,
                       "the body would have " + number_text(count) +
                           " particles, which need about " +
                           number_text(gigabytes) +
                           " GB of memory; this machine has " +
                           number_text(1e-9 * machine_memory()) + " GB.");
    else if (count > 1e6)
      findings.advise(path,
                      "the body has " + number_text(count) +
                          " particles, which need about " +
                          number_text(gigabytes) +
                          " GB of memory and a long time.");

    if (body.is_plain_lattice())
      check_rows(body, !scene.plate_bodies.empty(), findings);
  }
} // namespace Morsel::Scene
