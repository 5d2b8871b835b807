#ifndef morsel_core_step_clock_h
#define morsel_core_step_clock_h

namespace Morsel
{
  /// Time of a leapfrog whose step may change on the way.
  ///
  /// Times are products of a step and its number, not sums: they do not
  /// gather round-off, whatever a run's length.
  class StepClock
  {
  public:
    /// [s]
    double
    time() const
    {
      return now;
    }

    /// That of advance() [s].
    double
    time_step() const
    {
      return dt;
    }

    /// How many were done.
    unsigned long long
    step() const
    {
      return steps;
    }

    /// From the last half step to now [s]; 0 at first.
    double
    lag() const
    {
      return 0.5 * last_dt;
    }

    /// From the last half step to the next one [s].
    double
    kick() const
    {
      return lag() + 0.5 * dt;
    }

    /// The steps from now on [s].
    void
    set_time_step(const double time_step)
    {
      begin = now;
      first = steps;
      dt    = time_step;
    }

    void
    advance()
    {
      now     = begin + static_cast<double>(++steps - first) * dt;
      last_dt = dt;
    }

  private:
    double             dt = 0., last_dt = 0., now = 0.;
    double             begin = 0.;           ///< of steps of this length
    unsigned long long steps = 0, first = 0; ///< first: at begin
  };
} // namespace Morsel

#endif
