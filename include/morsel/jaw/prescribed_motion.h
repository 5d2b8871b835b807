#ifndef morsel_jaw_prescribed_motion_h
#define morsel_jaw_prescribed_motion_h

#include <morsel/jaw/frame.h>
#include <morsel/jaw/motion.h>

#include <memory>

namespace Morsel::Jaw
{
  /// A motion as a function of time.
  class PrescribedMotion
  {
  public:
    /// @pre the parameters are prescribed and complete
    explicit PrescribedMotion(const MotionParameters &parameters);

    ~PrescribedMotion();
    PrescribedMotion(PrescribedMotion &&) noexcept;

    Frame
    at(double time) const;

  private:
    struct Interpolation;

    const MotionParameters         parameters;
    std::unique_ptr<Interpolation> table;
  };


  /// Of a constant motion with its ramp and approach: velocity at a time [m/s].
  dealii::Tensor<1, 2>
  velocity_at(const MotionParameters &motion, double time);

  /// Displacement since time 0 [m].
  dealii::Tensor<1, 2>
  displacement_at(const MotionParameters &motion, double time);
} // namespace Morsel::Jaw

#endif
