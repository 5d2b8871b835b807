#ifndef morsel_output_checkpoint_h
#define morsel_output_checkpoint_h

#include <morsel/core/state_archive.h>

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace Morsel::Output
{
  /// What a checkpoint is of.
  struct CheckpointHead
  {
    std::string        scene;
    std::string        parameters; ///< used.prm
    unsigned long long step = 0;
    double             time = 0.; ///< [s]
  };


  /// The checkpoints of one run: a folder with, for each, one file of state by
  /// each rank and a list that names them with their sizes and checksums. The
  /// list is written last, so that a checkpoint is complete or is none.
  class CheckpointFolder
  {
  public:
    /// @param folder is created with the first checkpoint.
    /// @param kept so many of the newest are kept
    CheckpointFolder(const std::string &folder,
                     unsigned int       kept,
                     MPI_Comm           communicator);

    /// Writes a checkpoint; collective.
    /// @param state of this rank
    /// @throws FileError; the checkpoints of before are then still there.
    void
    write(const CheckpointHead &head, const std::string &state);

    /// The newest checkpoint that is good; collective.
    /// @param expected its scene and parameters
    /// @param complaints what is wrong with newer ones, a sentence each
    /// @throws InputError if there is none, or it is of another run; FileError
    ///   if none is good.
    StateArchive
    read_newest(const CheckpointHead     &expected,
                std::vector<std::string> &complaints) const;

    /// Moves what an earlier run left out of the way. @return where to, empty
    /// if there was nothing.
    std::string
    set_aside() const;

    /// The newest, as it can be named to the user; empty if there is none.
    const std::string &
    newest() const
    {
      return newest_list;
    }

  private:
    /// Names of the lists, the newest first.
    std::vector<std::string>
    lists() const;

    /// The parts that a list names; those of this rank alone if the ranks are
    /// as many as then.
    StateArchive
    read(const std::string &list, const CheckpointHead &expected) const;

    void
    remove_old() const;

    const std::string  folder;
    const unsigned int kept;
    const MPI_Comm     communicator;
    std::string        newest_list;
  };
} // namespace Morsel::Output

#endif
