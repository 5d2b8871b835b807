#ifndef morsel_fe_xfem_space_h
#define morsel_fe_xfem_space_h

#include <morsel/fe/cell_geometry.h>
#include <morsel/fracture/crack.h>

#include <deal.II/base/index_set.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/grid/tria.h>

#include <deal.II/hp/fe_collection.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace Morsel::FE
{
  /// How cracks enrich the space.
  struct EnrichmentParameters
  {
    /// Degree of the functions that multiply the tip functions.
    unsigned int tip_degree = 2;
    /// Vertices within this distance of a tip carry tip functions [m];
    /// 0: those of the cells that hold the tip.
    double radius = 0.;
    /// Blend the tip functions out over one layer of cells (corrected XFEM,
    /// Fries 2008) instead of dropping them at its outer nodes.
    bool ramp = true;
    /// A jump function whose support the crack leaves with less than this
    /// share of its area on one side is dropped [1]. Far below what counts:
    /// dropping at a share s costs K a relative 100 s (p = 2) to 600 s (p = 4).
    double area_tolerance = 1e-10;
  };


  /// Which enrichments live on one cell. Cracks and tips are given places
  /// ("slots") such that those which share a cell have different ones.
  struct CellEnrichment
  {
    static constexpr unsigned int max_slots = 4;
    static constexpr int          none      = -1;

    std::array<int, max_slots> jump_crack{{none, none, none, none}};
    std::array<int, max_slots> tip{{none, none, none, none}};
    /// The ramp's values at the cell's vertices, by tip slot.
    std::array<std::array<double, 4>, max_slots> ramp{};
    /// The constant side of each jump on a cell that its crack does not cut.
    std::array<double, max_slots> side{{0., 0., 0., 0.}};
    /// Whether the crack of each jump reaches the cell.
    std::array<bool, max_slots> touched{{false, false, false, false}};
    /// Whether a crack runs through the cell's interior.
    bool cut = false;

    bool
    enriched() const
    {
      return mask() != 0;
    }

    /// Bits of the slots in use: jumps first, then tips.
    unsigned int
    mask() const
    {
      unsigned int m = 0;
      for (unsigned int s = 0; s < max_slots; ++s)
        m |= (jump_crack[s] != none ? 1u << s : 0u) |
             (tip[s] != none ? 1u << (max_slots + s) : 0u);
      return m;
    }
  };


  /// Local numbering of one member of the finite element collection: the
  /// scalar functions of a cell are the base functions, then those of each
  /// jump slot, then of each tip slot and tip function.
  struct LocalNumbering
  {
    unsigned int degree   = 0; ///< of base and jump functions
    unsigned int mask     = 0;
    unsigned int n_base   = 0; ///< functions per base or jump block
    unsigned int n_tip    = 0; ///< functions per tip function
    unsigned int n_scalar = 0;
    /// By local dof: scalar function, component, kind (0 base, 1.. jump slot
    /// + 1, 1 + max_slots.. tip slot).
    std::vector<unsigned int> function, component, kind;
  };


  /// The enriched displacement space
  /// u = sum N_i u_i + sum_c H_c sum N_i a_i + sum_t R_t sum_k F_k sum N_j b_kj
  /// on hp::FECollection: FESystem of (FE_Q)^2, (FE_Q or FE_Nothing)^2 per
  /// jump slot, (FE_Q or FE_Nothing)^8 per tip slot. Not shifted: each
  /// multiplier a, b is itself a conforming finite element function, which
  /// keeps the product conforming at hanging nodes. The mesh knows nothing of
  /// the cracks. Works on serial and distributed triangulations.
  class XFEMSpace
  {
  public:
    using VertexField = dealii::LinearAlgebra::distributed::Vector<double>;

    /// @param cracks with their mouths extended beyond the body
    XFEMSpace(const dealii::Triangulation<2>          &triangulation,
              const std::vector<Fracture::Crack>      &cracks,
              const std::vector<EnrichmentParameters> &tip_parameters);

    /// Builds the space anew for the present mesh.
    /// @param degrees by active cell index; cells that carry enrichments and
    ///   those that share a face with one take the highest of all
    /// @throws InputError if a tip's functions would reach a kink of its crack
    void
    distribute(const std::vector<unsigned int> &degrees);

    const dealii::DoFHandler<2> &
    get_dof_handler() const
    {
      return dof_handler;
    }

    /// Hanging nodes and inactive functions, not closed: boundary conditions
    /// are added to a copy.
    const dealii::AffineConstraints<double> &
    get_constraints() const
    {
      return constraints;
    }

    const std::vector<Fracture::Crack> &
    get_cracks() const
    {
      return cracks;
    }

    const std::vector<Fracture::CrackTip> &
    get_tips() const
    {
      return tips;
    }

    const EnrichmentParameters &
    get_tip_parameters(const unsigned int tip) const
    {
      return tip_parameters[tip];
    }

    const CellEnrichment &
    get_enrichment(const unsigned int active_cell_index) const
    {
      return enrichments[active_cell_index];
    }

    const LocalNumbering &
    get_numbering(const unsigned int fe_index) const
    {
      return numberings[fe_index];
    }

    const LagrangeBasis &
    get_basis(const unsigned int degree) const
    {
      return bases.at(degree);
    }

    const dealii::IndexSet &
    get_relevant_dofs() const
    {
      return relevant_dofs;
    }

    /// Number of dofs that are neither constrained nor inactive, over all
    /// ranks.
    dealii::types::global_dof_index
    n_free_dofs() const;

    /// Number of vertex dofs of enrichments on this rank that the
    /// unification of the collection left apart and that had to be tied
    /// together by constraints.
    unsigned int
    n_tied_duplicates() const
    {
      return tied_duplicates;
    }

  private:
    /// What the supports of the enriched functions look like, by dof.
    struct SupportFields
    {
      VertexField left, right;  ///< area on either side of the crack [m^2]
      VertexField touched;      ///< number of cells that the crack reaches
      VertexField outside_core; ///< number of cells where jumps are needed
      VertexField forbidden;    ///< number of faces where it must vanish
    };

    void
    mark_vertices();
    bool
    holds_tip_of(const unsigned int crack, const QuadMap &map) const;
    void
    spread_to_parents(VertexField &marks) const;
    void
    classify_cells();
    void
    assign_slots(const std::vector<std::vector<int>> &jumps,
                 const std::vector<std::vector<int>> &tips_of_cell);
    std::vector<unsigned int>
    raise_degrees(std::vector<unsigned int> degrees) const;
    void
    enrich_cells(const std::vector<std::vector<int>> &jumps,
                 const std::vector<std::vector<int>> &tips_of_cell);
    void
    build_collection(const std::vector<unsigned int> &degrees);
    LocalNumbering
    make_numbering(const dealii::FiniteElement<2> &fe,
                   const unsigned int              degree,
                   const unsigned int              mask) const;
    void
    make_constraints();
    void
    tie_duplicates();
    void
    drop_inactive_functions();
    SupportFields
    gather_support(const dealii::AffineConstraints<double> &hanging) const;
    std::pair<double, double>
    areas_beside_crack(const dealii::DoFHandler<2>::cell_iterator &cell,
                       const unsigned int                          slot) const;
    bool
    is_core(const dealii::DoFHandler<2>::cell_iterator &cell,
            const unsigned int                          slot) const;
    bool
    is_outer_face(const dealii::DoFHandler<2>::cell_iterator &cell,
                  const unsigned int                          face,
                  const unsigned int                          kind,
                  const int                                   member) const;
    bool
    has_slot(const dealii::DoFHandler<2>::cell_iterator &cell,
             const unsigned int                          kind,
             const int                                   member) const;
    VertexField
    make_vertex_field() const;

    const dealii::Triangulation<2>   *triangulation;
    std::vector<Fracture::Crack>      cracks;
    std::vector<Fracture::CrackTip>   tips;
    std::vector<EnrichmentParameters> tip_parameters;

    dealii::DoFHandler<2>             vertex_handler;
    dealii::AffineConstraints<double> vertex_hanging;
    std::vector<VertexField>          jump_marks; ///< by crack
    std::vector<VertexField>          ramps;      ///< by tip

    dealii::hp::FECollection<2>           collection;
    dealii::DoFHandler<2>                 dof_handler;
    dealii::AffineConstraints<double>     constraints;
    dealii::IndexSet                      relevant_dofs;
    std::vector<LocalNumbering>           numberings; ///< by fe index
    std::map<unsigned int, LagrangeBasis> bases;
    std::vector<CellEnrichment>           enrichments; ///< by active cell index
    std::vector<int>                      jump_slot;   ///< by crack
    std::vector<int>                      tip_slot;    ///< by tip
    unsigned int                          tied_duplicates = 0;
  };
} // namespace Morsel::FE

#endif
