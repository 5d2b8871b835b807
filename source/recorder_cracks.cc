#include "recorder_cracks.h"
#include "run_summary.h"
#include "tip_summary.h"

#include <morsel/core/suggestions.h>

#include <algorithm>
#include <cmath>

namespace Morsel
{
  namespace
  {
    /// Faces that overlap by less than this share of the largest opening are
    /// round-off.
    constexpr double noticeable_overlap = 1e-6;
  } // namespace


  ToothCrackRecorder::ToothCrackRecorder(const Bite &bite, RunLog &log)
      : bite(bite)
      , log(log)
  {
    const auto &plates = bite.get_plates();
    for (unsigned int p = 0; p < plates.size(); ++p)
      {
        const auto *const deformation = plates[p].get_deformation();
        if (!deformation || !deformation->get_body().cracks())
          continue;
        const auto &cracks = *deformation->get_body().cracks();
        Body        body{p, plates[p].body.name, {}};
        body.name = underscored(body.name);
        for (const std::string &suffix : tip_suffixes(cracks.get_tips()))
          {
            Tip tip;
            tip.suffix    = "_" + body.name + suffix;
            tip.toughness = plates[p].body.deformation.fracture_toughness;
            body.tips.push_back(tip);
          }
        for (const auto &rings : cracks.get_rings())
          if (!rings.remark.empty())
            log.warning("Body '" + plates[p].body.name + "': " + rings.remark);
        bodies.push_back(body);
      }
  }


  std::vector<std::string>
  ToothCrackRecorder::columns() const
  {
    std::vector<std::string> c;
    for (const Body &body : bodies)
      {
        for (const Tip &tip : body.tips)
          for (const char *const mode : {"I", "II"})
            c.push_back("stress_intensity_" + std::string(mode) + tip.suffix +
                        " [" + stress_intensity_unit + "]");
        c.push_back("smallest_crack_opening_" + body.name + " [m]");
      }
    return c;
  }


  void
  ToothCrackRecorder::follow_tip(Tip                            &tip,
                                 const Fracture::RingStatistics &K,
                                 const double                    force) const
  {
    const auto hoop = Fracture::largest_hoop_stress(K.mean);
    const auto keep = [&](Moment &largest, const double value) {
      if (std::abs(value) > std::abs(largest.K))
        largest = {bite.time(), force, value, hoop.direction};
    };
    keep(tip.largest_I, std::max(0., K.mean.mode_I));
    keep(tip.largest_II, K.mean.mode_II);
    keep(tip.largest, hoop.equivalent);
    tip.smallest_I = std::min(tip.smallest_I, K.mean.mode_I);
    tip.largest_spread =
        std::max({tip.largest_spread, K.spread.mode_I, K.spread.mode_II});
    if (!tip.growth && hoop.equivalent >= tip.toughness)
      tip.growth = {bite.time(), force, hoop.equivalent, hoop.direction};
  }


  std::vector<double>
  ToothCrackRecorder::follow(const std::vector<double> &forces)
  {
    std::vector<double> row;
    for (Body &body : bodies)
      {
        const auto &deformation =
            *bite.get_plates()[body.plate].get_deformation();
        const auto           &cracks = *deformation.get_body().cracks();
        const Eigen::VectorXd u      = deformation.displacement();
        const auto            K      = cracks.stress_intensity(u);
        for (unsigned int t = 0; t < K.size(); ++t)
          {
            follow_tip(body.tips[t], K[t], forces[body.plate]);
            row.push_back(K[t].mean.mode_I);
            row.push_back(K[t].mean.mode_II);
          }
        const double opening = cracks.smallest_opening(u);
        body.largest_opening = std::max(body.largest_opening, opening);
        if (opening < body.smallest_opening)
          {
            body.smallest_opening  = opening;
            body.force_at_smallest = forces[body.plate];
          }
        row.push_back(opening);
      }
    return row;
  }


  void
  ToothCrackRecorder::summarise(Output::Summary &summary) const
  {
    for (const Body &body : bodies)
      {
        for (const Tip &tip : body.tips)
          summarise_tip(summary, tip);
        summary.add("largest_crack_overlap_" + body.name,
                    std::max(0., -body.smallest_opening),
                    "m",
                    "by how much the faces of its cracks would pass each other "
                    "at any sample: they are closed there, which is not "
                    "modelled");
        if (-body.smallest_opening > noticeable_overlap * body.largest_opening)
          log.warning(
              "Faces of cracks in body '" +
              bite.get_plates()[body.plate].body.name +
              "' would overlap by up to " +
              number_text(-body.smallest_opening) + " m (at a force of " +
              number_text(body.force_at_smallest) +
              " N): the crack is closed there, which is not modelled. Where "
              "K_I is negative it means zero, and K_II is that of faces "
              "without friction.");
      }
  }


  void
  ToothCrackRecorder::summarise_tip(Output::Summary &summary,
                                    const Tip       &tip) const
  {
    const auto add = [&](const std::string &name,
                         const Moment      &moment,
                         const std::string &meaning) {
      summary.add(name + tip.suffix, moment.K, stress_intensity_unit, meaning);
      summary.add("time_of_" + name + tip.suffix,
                  moment.time,
                  "s",
                  "when it was reached");
      summary.add("force_at_" + name + tip.suffix,
                  moment.force,
                  "N",
                  "normal force on the body at that moment");
    };
    add("largest_stress_intensity_I", tip.largest_I, "largest K_I of the tip");
    add("largest_stress_intensity_II",
        tip.largest_II,
        "K_II of the tip where it was largest in size");
    add("largest_equivalent_stress_intensity",
        tip.largest,
        "largest K of K_I and K_II by the criterion of hoop stress; a "
        "negative K_I counts as zero");
    summary.add("smallest_stress_intensity_I" + tip.suffix,
                tip.smallest_I,
                stress_intensity_unit,
                "smallest K_I; negative: the crack is closed");
    summary.add("stress_intensity_spread" + tip.suffix,
                tip.largest_spread,
                stress_intensity_unit,
                "largest difference of K between the rings about the tip: its "
                "own estimate of error");
    summary.add("fracture_toughness" + tip.suffix,
                tip.toughness,
                stress_intensity_unit,
                "K_Ic that the scene gives");
    summary.add("crack_would_grow" + tip.suffix,
                tip.growth ? 1. : 0.,
                "1",
                "1 if the equivalent K reached K_Ic at a sample, else 0; the "
                "crack stays as it is");
    if (!tip.growth)
      return;
    summary.add("time_of_crack_growth" + tip.suffix,
                tip.growth->time,
                "s",
                "first sample at which it would grow");
    summary.add("force_at_crack_growth" + tip.suffix,
                tip.growth->force,
                "N",
                "normal force on the body at that sample");
    summary.add("angle_of_crack_growth" + tip.suffix,
                tip.growth->angle * 180. / dealii::numbers::PI,
                "degrees",
                "direction in which it would then grow, from its own one to "
                "its left");
  }
} // namespace Morsel
