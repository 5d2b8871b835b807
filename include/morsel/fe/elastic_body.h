#ifndef morsel_fe_elastic_body_h
#define morsel_fe_elastic_body_h

#include <morsel/fe/crack_functionals.h>
#include <morsel/fe/multifrontal.h>
#include <morsel/fe/xfem_space.h>
#include <morsel/fracture/elastic_plane.h>

#include <deal.II/grid/tria.h>

#include <Eigen/Sparse>

#include <functional>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace Morsel::FE
{
  /// What a linear elastic body in plane strain is made of and how it is held.
  struct ElasticBodyProperties
  {
    double       youngs_modulus = 0.; ///< [Pa]
    double       poissons_ratio = 0.; ///< [1]
    double       density        = 0.; ///< [kg/m^3]
    double       depth          = 1.; ///< out of plane [m]
    unsigned int degree         = 1;  ///< of the displacement
    /// Parts of the boundary whose displacement is prescribed: zero, relative
    /// to a frame that moves with them.
    std::set<dealii::types::boundary_id> held;
  };


  /// The cracks of a body, which its mesh knows nothing of.
  struct ElasticBodyCracks
  {
    /// With their mouths extended beyond the body.
    std::vector<Fracture::Crack> cracks;
    double                       ring_radius = 0.; ///< see choose_rings() [m]
  };


  /// The stress of a body at the corners of its cells, for output. Cells that
  /// a crack cuts are given in pieces, so that a deformed crack is open.
  struct CellCornerFields
  {
    std::vector<dealii::Point<2>> points;       ///< in deal.II's order [m]
    std::vector<double>           displacement; ///< x, y per point [m]
    std::vector<double>           stress;    ///< xx, xy, yx, yy per point [Pa]
    std::vector<double>           von_mises; ///< [Pa]
  };


  /// A linear elastic body whose boundary is loaded: stiffness, consistent mass
  /// and the trace of its displacement on a polyline along the boundary. It
  /// stands on the XFEM space and may have cracks. Its unknowns are those of
  /// the space with all constraints (hanging nodes, inactive and duplicate
  /// functions) condensed: matrices have nothing in the rows of constrained
  /// dofs, whose values in vectors are zero and mean nothing.
  class ElasticBody
  {
  public:
    /// @param mesh of quadrilaterals, with boundary ids; may have hanging nodes
    /// @throws InputError if two crack tips share a cell, tip functions would
    ///   reach a kink, or rings do not fit
    ElasticBody(std::unique_ptr<dealii::Triangulation<2>> mesh,
                const ElasticBodyProperties              &properties,
                const ElasticBodyCracks                  &cracks = {});

    unsigned int
    n_dofs() const
    {
      return space->get_dof_handler().n_dofs();
    }

    unsigned int
    n_cells() const
    {
      return mesh->n_active_cells();
    }

    /// Nodes of the boundary's polyline where they are without load [m].
    const std::vector<dealii::Point<2>> &
    surface_nodes() const
    {
      return nodes;
    }

    /// Its facets, the body to the left when walking from first to second.
    const std::vector<std::pair<unsigned int, unsigned int>> &
    surface_facets() const
    {
      return facets;
    }

    /// Displacement of node k, component c, in row 2 k + c from the dofs; its
    /// transpose gives the dofs' loads from forces on the nodes, with the
    /// same sum, since the functions of a cell add up to one.
    const Eigen::SparseMatrix<double> &
    trace() const
    {
      return surface_trace;
    }

    /// K and opening of its cracks; null if it has none.
    const CrackFunctionals *
    cracks() const
    {
      return crack_functionals.get();
    }

    /// Over all dofs, the held ones included [N/m], [kg].
    const Eigen::SparseMatrix<double> &
    stiffness() const
    {
      return K;
    }
    const Eigen::SparseMatrix<double> &
    mass() const
    {
      return M;
    }

    /// Dofs of a uniform unit displacement along a direction.
    Eigen::VectorXd
    uniform(unsigned int component) const;

    /// 1 where a dof is held, else 0.
    const Eigen::VectorXd &
    held() const
    {
      return held_dofs;
    }

    bool
    is_held() const
    {
      return held_dofs.maxCoeff() > 0.;
    }

    /// Factors of a K + b M on the dofs that are not held; held ones get zero
    /// in a solution.
    /// @pre b > 0, or a > 0 and held
    Multifrontal
    factorise(double stiffness_factor, double mass_factor) const;

    /// Displacement and stress for output.
    CellCornerFields
    corner_fields(const Eigen::VectorXd &displacement) const;

  private:
    struct Element
    {
      dealii::Point<2>                             center;
      std::vector<dealii::types::global_dof_index> dofs;
      Eigen::MatrixXd stiffness, mass; ///< [N/m], [kg]
    };
    using UseOfElement = std::function<void(const Element &)>;

    void
    for_each_element(const UseOfElement &use) const;
    void
    make_expansion();
    void
    make_matrices();
    void
    find_held_dofs();
    void
    make_surface();

    ElasticBodyProperties                     properties;
    Fracture::ElasticPlane                    material;
    std::unique_ptr<dealii::Triangulation<2>> mesh;
    std::unique_ptr<XFEMSpace>                space;
    dealii::AffineConstraints<double>         constraints;
    Eigen::SparseMatrix<double>       expansion; ///< all dofs from free ones
    std::unique_ptr<CrackFunctionals> crack_functionals;
    std::vector<dealii::Point<2>>     nodes;
    std::vector<std::pair<unsigned int, unsigned int>> facets;
    Eigen::SparseMatrix<double>                        K, M, surface_trace;
    Eigen::VectorXd                                    held_dofs;
  };
} // namespace Morsel::FE

#endif
