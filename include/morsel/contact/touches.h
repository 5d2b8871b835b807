#ifndef morsel_contact_touches_h
#define morsel_contact_touches_h

#include <deal.II/base/tensor.h>

#include <utility>
#include <vector>

namespace Morsel::Contact
{
  /// The particles that press on a surface, and how the forces on it change
  /// when its nodes move: by -stiffness sum_k share_k du_k each.
  struct Touches
  {
    struct Touch
    {
      dealii::Tensor<2, 2> stiffness;   ///< [N/m]
      unsigned int         first, last; ///< of the shares, [first, last)
    };

    std::vector<Touch>                           list;
    std::vector<std::pair<unsigned int, double>> shares; ///< node, weight [1]

    void
    clear()
    {
      list.clear();
      shares.clear();
    }
  };
} // namespace Morsel::Contact

#endif
