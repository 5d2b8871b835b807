#ifndef morsel_core_state_archive_fwd_h
#define morsel_core_state_archive_fwd_h

namespace Morsel
{
  class StateArchive;
}

#endif
