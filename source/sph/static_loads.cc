#include <morsel/sph/field_vectors.h>
#include <morsel/sph/static_solid.h>

namespace Morsel::SPH
{
  using namespace dealii;

  namespace
  {
    /// Weights of one component.
    VectorField
    along(const std::vector<double> &weight, const unsigned int component)
    {
      VectorField result(weight.size());
      for (unsigned int k = 0; k < weight.size(); ++k)
        result[k][component] = weight[k];
      return result;
    }
  } // namespace


  void
  StaticSolid::apply_traction(const unsigned int  side,
                              const Tensor<1, 2> &traction)
  {
    for (const BoundaryFacet &facet : boundary)
      if (facet.side == side)
        for (unsigned int k = 0; k < facet.index.size(); ++k)
          load[facet.index[k]] += facet.weight[k] * traction;
  }


  void
  StaticSolid::apply_force(const ShapeValues &place, const Tensor<1, 2> &force)
  {
    for (unsigned int k = 0; k < place.index.size(); ++k)
      load[place.index[k]] += place.value[k] * force;
  }


  void
  StaticSolid::apply_force(const unsigned int i, const Tensor<1, 2> &force)
  {
    load[i] += force;
  }


  void
  StaticSolid::hold(const unsigned int side,
                    const unsigned int component,
                    const double       displacement)
  {
    for (const BoundaryFacet &facet : boundary)
      if (facet.side == side)
        hold(facet, component, displacement);
  }


  void
  StaticSolid::hold(const BoundaryFacet &facet,
                    const unsigned int   component,
                    const double         displacement)
  {
    constraints.push_back(
        {penalty * youngs_modulus / (facet.length * facet.length),
         facet.length,
         facet.index,
         along(facet.weight, component),
         facet.length * displacement});
  }


  void
  StaticSolid::hold_across(const BoundaryFacet &facet)
  {
    constraints.push_back(
        {penalty * youngs_modulus / (facet.length * facet.length),
         facet.length,
         facet.index,
         facet.flux});
  }


  void
  StaticSolid::pin(const ShapeValues &place,
                   const unsigned int component,
                   const double       displacement)
  {
    constraints.push_back({penalty * youngs_modulus,
                           1.,
                           place.index,
                           along(place.value, component),
                           displacement});
  }
} // namespace Morsel::SPH
