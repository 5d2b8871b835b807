#include <morsel/core/atomic_file.h>
#include <morsel/core/build.h>
#include <morsel/core/failure.h>
#include <morsel/core/suggestions.h>
#include <morsel/output/checkpoint.h>

#include <boost/crc.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace Morsel::Output
{
  namespace
  {
    namespace fs  = std::filesystem;
    namespace MPI = dealii::Utilities::MPI;

    /// Of the layout of the state; a new one where classes change theirs.
    constexpr int format = 5;

    const std::string list_ending = ".json";


    unsigned int
    checksum(const std::string &content)
    {
      boost::crc_32_type crc;
      crc.process_bytes(content.data(), content.size());
      return crc.checksum();
    }


    std::string
    read_file(const std::string &file_name)
    {
      std::ifstream      file(file_name, std::ios::binary);
      std::ostringstream content;
      content << file.rdbuf();
      if (!file)
        throw FileError("cannot be read (" + std::string(std::strerror(errno)) +
                        ")");
      return content.str();
    }


    std::string
    file_stem(const unsigned long long step)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "step_%012llu", step);
      return text;
    }


    std::string
    list_checksum(nlohmann::ordered_json list)
    {
      list.erase("checksum");
      return std::to_string(checksum(list.dump()));
    }


    /// A list whose own checksum is right. @throws FileError saying what is
    /// wrong
    nlohmann::ordered_json
    read_list(const std::string &file_name)
    {
      const auto list =
          nlohmann::ordered_json::parse(read_file(file_name), nullptr, false);
      if (!list.is_object() || !list.contains("checksum") ||
          list["checksum"] != list_checksum(list))
        throw FileError("is damaged");
      if (list["program"] != "morsel")
        throw FileError("is not of this program");
      if (list["format"] != format || list["version"] != MORSEL_VERSION)
        throw FileError("is of another version of the program (" +
                        list["version"].get<std::string>() + ", this is " +
                        MORSEL_VERSION + ")");
      return list;
    }


    /// The first text that is not empty, on all ranks.
    std::string
    first_of_ranks(const std::string &text, const MPI_Comm communicator)
    {
      for (const std::string &of_rank : MPI::all_gather(communicator, text))
        if (!of_rank.empty())
          return of_rank;
      return "";
    }


    /// Whether a run may go on with another value of an entry: those that say
    /// how far, in which steps, and how often checkpoints are made.
    bool
    may_differ(const std::string &line)
    {
      for (const char *entry : {"Checkpoint",
                                "Time step",
                                "CFL factor",
                                "Retries",
                                "End time",
                                "Repartition"})
        if (trimmed(line).rfind(std::string("set ") + entry, 0) == 0)
          return true;
      return false;
    }


    void
    check_parameters(const std::string &before, const std::string &now)
    {
      std::istringstream old_lines(before), new_lines(now);
      for (std::string a, b;;)
        {
          const bool more = static_cast<bool>(std::getline(old_lines, a));
          if (more != static_cast<bool>(std::getline(new_lines, b)))
            throw InputError("it was made with other parameters");
          if (!more)
            return;
          if (a != b && !may_differ(a))
            throw InputError("it was made with '" + trimmed(a) +
                             "', the scene now says '" + trimmed(b) + "'");
        }
    }
  } // namespace


  CheckpointFolder::CheckpointFolder(const std::string &folder,
                                     const unsigned int kept,
                                     const MPI_Comm     communicator)
      : folder(folder)
      , kept(kept)
      , communicator(communicator)
  {}


  void
  CheckpointFolder::write(const CheckpointHead &head, const std::string &state)
  {
    const unsigned int rank = MPI::this_mpi_process(communicator);
    const std::string  stem = file_stem(head.step);
    const std::string  part = stem + ".rank" + std::to_string(rank);
    run_on_all_ranks(communicator, [&] {
      // Not the folder of results: if that has gone, the user shall know.
      std::error_code error;
      fs::create_directory(folder, error);
      if (error)
        throw FileError("Cannot create the folder '" + folder +
                        "': " + error.message() + ".");
      write_atomically(folder + "/" + part, state);
    });

    const auto sizes = MPI::gather(communicator, state.size(), 0);
    const auto sums  = MPI::gather(communicator, checksum(state), 0);
    run_on_all_ranks(communicator, [&] {
      if (rank != 0)
        return;
      nlohmann::ordered_json list;
      list["program"] = "morsel";
      list["version"] = MORSEL_VERSION;
      list["format"]  = format;
      list["scene"]   = head.scene;
      list["step"]    = head.step;
      list["time"]    = head.time;
      list["parts"]   = nlohmann::ordered_json::array();
      for (unsigned int r = 0; r < sizes.size(); ++r)
        list["parts"].push_back({{"file", stem + ".rank" + std::to_string(r)},
                                 {"bytes", sizes[r]},
                                 {"crc32", sums[r]}});
      list["parameters"] = head.parameters;
      list["checksum"]   = list_checksum(list);
      write_atomically(folder + "/" + stem + list_ending, list.dump(1) + "\n");
      remove_old();
    });
    newest_list = folder + "/" + stem + list_ending;
  }


  std::vector<std::string>
  CheckpointFolder::lists() const
  {
    std::vector<std::string> names;
    std::error_code          error;
    for (const auto &entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == list_ending)
        names.push_back(entry.path().filename());
    std::sort(names.rbegin(), names.rend());
    return names;
  }


  void
  CheckpointFolder::remove_old() const
  {
    const auto names = lists();
    if (names.size() <= kept)
      return;
    // Parts without a list are what a run that was killed left.
    const std::string oldest_kept = fs::path(names[kept - 1]).stem();
    std::error_code   ignored;
    for (std::size_t k = kept; k < names.size(); ++k)
      fs::remove(folder + "/" + names[k], ignored);
    std::vector<fs::path> old;
    for (const auto &entry : fs::directory_iterator(folder, ignored))
      if (const std::string name = entry.path().filename();
          name.rfind("step_", 0) == 0 && name < oldest_kept)
        old.push_back(entry.path());
    for (const auto &path : old)
      fs::remove(path, ignored);
  }


  StateArchive
  CheckpointFolder::read(const std::string    &list_name,
                         const CheckpointHead &expected) const
  {
    const auto list = read_list(folder + "/" + list_name);
    if (list["scene"] != expected.scene)
      throw InputError("it is of the scene '" +
                       list["scene"].get<std::string>() + "'");
    check_parameters(list["parameters"], expected.parameters);

    const unsigned int       rank  = MPI::this_mpi_process(communicator);
    const unsigned int       n     = MPI::n_mpi_processes(communicator);
    const auto              &parts = list["parts"];
    const bool               same  = parts.size() == n;
    std::vector<std::string> contents;
    for (unsigned int r = 0; r < parts.size(); ++r)
      if (r % n == rank)
        {
          const std::string name = parts[r]["file"];
          try
            {
              contents.push_back(read_file(folder + "/" + name));
            }
          catch (const FileError &error)
            {
              throw FileError("cannot be used: its part '" + name + "' " +
                              error.what());
            }
          if (contents.back().size() != parts[r]["bytes"] ||
              checksum(contents.back()) != parts[r]["crc32"])
            throw FileError("cannot be used: its part '" + name +
                            "' is damaged (checksum)");
        }
    return same ? StateArchive(std::move(contents.front()))
                : StateArchive(std::move(contents), communicator);
  }


  StateArchive
  CheckpointFolder::read_newest(const CheckpointHead     &expected,
                                std::vector<std::string> &complaints) const
  {
    const auto names = lists();
    if (names.empty())
      throw InputError("--resume: there is no checkpoint in '" + folder +
                       "' to go on from; leave the option out to start anew.");
    for (const std::string &name : names)
      {
        // A part may be bad for one rank only.
        StateArchive state;
        std::string  damage, difference;
        try
          {
            state = read(name, expected);
          }
        catch (const InputError &error)
          {
            difference = error.what();
          }
        catch (const FileError &error)
          {
            damage = error.what();
          }
        damage     = first_of_ranks(damage, communicator);
        difference = first_of_ranks(difference, communicator);
        if (!difference.empty())
          throw InputError("--resume: the checkpoint '" + folder + "/" + name +
                           "' does not belong to this run: " + difference +
                           ". Give the scene as it was, or another folder "
                           "with --output.");
        if (damage.empty())
          return state;
        complaints.push_back("The checkpoint '" + folder + "/" + name + "' " +
                             damage + ".");
      }
    std::string text;
    for (const auto &complaint : complaints)
      text += complaint + " ";
    throw FileError("--resume: no checkpoint is good. " + text +
                    "Leave the option out to start anew.");
  }


  std::string
  CheckpointFolder::set_aside() const
  {
    if (lists().empty())
      return "";
    const std::string place = folder + "_before";
    std::error_code   error;
    fs::remove_all(place, error);
    fs::rename(folder, place, error);
    if (error)
      throw FileError("Cannot move the checkpoints of an earlier run from '" +
                      folder + "' to '" + place + "': " + error.message() +
                      ".");
    return place;
  }
} // namespace Morsel::Output
