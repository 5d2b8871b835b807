#include <morsel/measure/energy_ledger.h>

#include <boost/test/unit_test.hpp>

using namespace Morsel::Measure;
using dealii::Tensor;


BOOST_AUTO_TEST_SUITE(ledgers)


BOOST_AUTO_TEST_CASE(energy_closes_and_its_gap_is_seen)
{
  Energies start;
  start.kinetic = 1.;
  EnergyLedger ledger(start);

  Energies loaded;
  loaded.strain        = 4.5;
  loaded.kinetic       = 0.5;
  loaded.external_work = 4.;
  BOOST_CHECK_SMALL(ledger.record(loaded, 10.), 1e-15);

  // 0.2 J of 10 J are missing at the peak of the force ...
  Energies peak                     = loaded;
  peak.external_work                = 10.;
  peak.strain                       = 9.8;
  peak.contact                      = 0.25;
  peak.dissipated_granular_friction = 0.25;
  BOOST_CHECK_CLOSE(ledger.record(peak, 20.), 0.02, 1e-8);

  // ... and 0.5 J at the end, still over the largest term seen.
  Energies end;
  end.external_work        = 10.;
  end.dissipated_damage    = 9.;
  end.dissipated_viscosity = 1.5;
  BOOST_CHECK_CLOSE(ledger.record(end, 2.), 0.05, 1e-8);

  BOOST_CHECK_CLOSE(ledger.error_at_peak(), 0.02, 1e-8);
  BOOST_CHECK_CLOSE(ledger.error_at_end(), 0.05, 1e-8);
  BOOST_CHECK_CLOSE(ledger.largest_error(), 0.05, 1e-8);
  BOOST_CHECK_CLOSE(ledger.last().dissipated(), 10.5, 1e-8);
}


BOOST_AUTO_TEST_CASE(every_term_is_in_the_sums)
{
  const Energies all{1.,
                     2.,
                     4.,
                     8.,
                     16.,
                     32.,
                     64.,
                     10000.,
                     128.,
                     256.,
                     512.,
                     1024.,
                     2048.,
                     4096.,
                     8192.};
  BOOST_CHECK_EQUAL(all.stored(), 127.);
  BOOST_CHECK_EQUAL(all.dissipated(), 16256.);
  BOOST_CHECK_EQUAL(all.largest_term(), 10000.);
  EnergyLedger empty{Energies{}};
  BOOST_CHECK_EQUAL(empty.record(Energies{}, 0.), 0.);
}


BOOST_AUTO_TEST_CASE(momentum_is_explained_by_impulses)
{
  MomentumLedger ledger(Tensor<1, 2>{{0., -2.}}, 2.);
  BOOST_CHECK_SMALL(
      ledger.record(Tensor<1, 2>{{1., 1.}},
                    1.5,
                    {Tensor<1, 2>{{1., 5.}}, Tensor<1, 2>{{0., -2.}}}),
      1e-15);
  const double impulse = Tensor<1, 2>{{1., 5.}}.norm();
  BOOST_CHECK_CLOSE(
      ledger.record(Tensor<1, 2>{{1., 1.}},
                    1.5,
                    {Tensor<1, 2>{{1., 5.}}, Tensor<1, 2>{{0., -2.5}}}),
      0.5 / impulse,
      1e-8);
  BOOST_CHECK_EQUAL(ledger.error(), ledger.largest_error());
}


BOOST_AUTO_TEST_CASE(momenta_that_cancel_have_a_scale)
{
  // Two masses fly apart; round-off of their sum is round-off.
  MomentumLedger ledger(Tensor<1, 2>(), 8.);
  BOOST_CHECK_CLOSE(
      ledger.record(Tensor<1, 2>{{0., 1e-15}}, 6., {}), 1e-15 / 8., 1e-8);
}


BOOST_AUTO_TEST_SUITE_END()
