// What finding the facets near particles costs: a row of particles along a
// plate, n of both.
#include <morsel/contact/plate_contact.h>

#include <benchmark/benchmark.h>

using namespace Morsel;

namespace
{
  void
  contact_search(benchmark::State &state)
  {
    const unsigned int n       = state.range(0);
    constexpr double   spacing = 1e-4;
    Contact::Surface   plate   = Contact::rectangle_surface(
        "plate", {0., -0.001}, {n * spacing, 0.}, spacing);
    const ParticleSide            side{spacing, 0.01, 1e-7, 1e7, 1e7, spacing};
    std::vector<dealii::Point<2>> reference;
    for (unsigned int i = 0; i < n; ++i)
      reference.emplace_back((i + 0.5) * spacing, 0.4 * spacing);
    const std::vector<Motion> motion(n, Motion{0., 0., 0., 0.});
    for (auto _ : state)
      {
        const auto contact = Contact::make_plate_contact({}, side);
        benchmark::DoNotOptimize(
            contact->compute(reference, motion, n, 1e-6, plate).size());
      }
    state.SetComplexityN(n);
  }
} // namespace

BENCHMARK(contact_search)->RangeMultiplier(4)->Range(256, 65536)->Complexity();
