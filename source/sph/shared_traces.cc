#include <morsel/core/gather.h>
#include <morsel/sph/shared_traces.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace Morsel::SPH
{
  namespace
  {
    /// A particle of a shared trace, as its owner tells the others.
    struct Entry
    {
      unsigned long long condition, number, id;
      double             weight, mass;
    };


    unsigned int
    count_owned(const WholeTrace &trace, const LocalNumbers &owned)
    {
      return std::count_if(
          trace.id.begin(), trace.id.end(), [&](const unsigned long long id) {
            return owned.find(id) >= 0;
          });
    }


    /// The traces of all conditions with places for ids.
    struct Numbered
    {
      std::vector<Prescribed>   traces;
      std::vector<unsigned int> condition;
      std::vector<bool>         shared;

      Numbered(const std::vector<TracesOfCondition> &conditions,
               const LocalNumbers                   &owned)
      {
        std::map<unsigned long long, unsigned int> place;
        for (unsigned int c = 0; c < conditions.size(); ++c)
          for (const WholeTrace &whole : conditions[c].traces)
            {
              Prescribed q;
              q.trace.weight = whole.weight;
              for (const unsigned long long id : whole.id)
                q.trace.particle.push_back(
                    place.emplace(id, place.size()).first->second);
              traces.push_back(q);
              condition.push_back(c);
              shared.push_back(count_owned(whole, owned) < whole.id.size());
            }
      }

      /// Those that are coupled in a component.
      void
      share_groups(const std::vector<TracesOfCondition> &conditions,
                   const unsigned int                    component)
      {
        std::vector<Prescribed *> list;
        std::vector<unsigned int> of_list;
        for (unsigned int k = 0; k < traces.size(); ++k)
          if (conditions[condition[k]].prescribes[component])
            {
              list.push_back(&traces[k]);
              of_list.push_back(k);
            }
        for (const auto &group : coupled_groups(list))
          if (group.size() > 1)
            for (const unsigned int k : group)
              shared[of_list[k]] = true;
      }
    };


    SharedTraces
    make_traces(std::vector<Entry>  entries,
                const std::size_t   n_conditions,
                const LocalNumbers &owned)
    {
      std::sort(
          entries.begin(), entries.end(), [](const Entry &a, const Entry &b) {
            return std::tie(a.condition, a.number, a.id) <
                   std::tie(b.condition, b.number, b.id);
          });
      SharedTraces result;
      result.prescribed.resize(n_conditions);
      std::map<unsigned long long, unsigned int> place;
      const Entry                               *last = nullptr;
      for (const Entry &entry : entries)
        {
          auto &list = result.prescribed[entry.condition];
          if (!last || last->condition != entry.condition ||
              last->number != entry.number)
            {
              list.emplace_back();
              list.back().counts = owned.find(entry.id) >= 0;
            }
          last                   = &entry;
          const auto [p, is_new] = place.emplace(entry.id, result.id.size());
          if (is_new)
            {
              result.id.push_back(entry.id);
              result.mass.push_back(entry.mass);
            }
          list.back().trace.particle.push_back(p->second);
          list.back().trace.weight.push_back(entry.weight);
        }
      return result;
    }
  } // namespace


  SharedTraces
  take_shared_traces(std::vector<TracesOfCondition> &conditions,
                     const LocalNumbers             &owned,
                     const Particles                &p,
                     const ParticleHost<2>          &ranks)
  {
    for (auto &condition : conditions)
      {
        auto &traces = condition.traces;
        traces.erase(std::remove_if(traces.begin(),
                                    traces.end(),
                                    [&](const WholeTrace &trace) {
                                      return count_owned(trace, owned) == 0;
                                    }),
                     traces.end());
      }
    Numbered numbered(conditions, owned);
    for (const unsigned int d : {0u, 1u})
      numbered.share_groups(conditions, d);

    std::vector<Entry> entries;
    unsigned int       k = 0;
    for (unsigned int c = 0; c < conditions.size(); ++c)
      {
        std::vector<WholeTrace> own;
        for (WholeTrace &trace : conditions[c].traces)
          if (!numbered.shared[k++])
            own.push_back(std::move(trace));
          else
            for (unsigned int m = 0; m < trace.id.size(); ++m)
              if (const long i = owned.find(trace.id[m]); i >= 0)
                entries.push_back(
                    {c, trace.number, trace.id[m], trace.weight[m], p.mass[i]});
        conditions[c].traces = std::move(own);
      }
    return make_traces(
        gather(entries, ranks.communicator()), conditions.size(), owned);
  }


  Trace
  part_of_rank(const Trace                           &trace,
               const std::vector<unsigned long long> &id,
               const LocalNumbers                    &owned)
  {
    Trace part;
    for (unsigned int m = 0; m < trace.particle.size(); ++m)
      if (const long i = owned.find(id[trace.particle[m]]); i >= 0)
        {
          part.particle.push_back(i);
          part.weight.push_back(trace.weight[m]);
        }
    return part;
  }
} // namespace Morsel::SPH
