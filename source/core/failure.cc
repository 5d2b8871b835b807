#include <morsel/core/errors.h>
#include <morsel/core/failure.h>
#include <morsel/core/sentences.h>
#include <morsel/core/signals.h>
#include <morsel/core/suggestions.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_control.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <thread>

namespace Morsel
{
  namespace
  {
    struct Failure
    {
      ExitStatus  status;
      std::string sentence;
    };


    /// A failure of one rank as the others see it.
    struct FailedElsewhere
    {
      Failure failure;
    };


    /// deal.II's exceptions carry paragraphs of advice for programmers: keep
    /// what happened, and where.
    Failure
    describe(const dealii::ExceptionBase &error)
    {
      std::ostringstream info;
      error.print_info(info);
      std::string text = trimmed(info.str());
      for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos;)
        text.replace(i, text.find_first_not_of(" \n", i) - i, " ");
      if (text.empty() || text == "(none)")
        text = error.get_exc_name();

      const bool of_files =
          dynamic_cast<const dealii::StandardExceptions::ExcIO *>(&error) ||
          dynamic_cast<const dealii::StandardExceptions::ExcFileNotOpen *>(
              &error);
      if (of_files)
        return {ExitStatus::bad_files, text};
      if (dynamic_cast<const dealii::SolverControl::NoConvergence *>(&error))
        return {ExitStatus::bad_numbers, text};
      return {ExitStatus::fault, "A fault inside of the program: " + text};
    }


    /// What a caught exception means; call it in a catch block.
    Failure
    describe_current_exception()
    {
      try
        {
          throw;
        }
      catch (const InputError &error)
        {
          return {ExitStatus::bad_input, error.what()};
        }
      catch (const NumericalError &error)
        {
          return {ExitStatus::bad_numbers, error.what()};
        }
      catch (const FileError &error)
        {
          return {ExitStatus::bad_files, error.what()};
        }
      catch (const Interrupted &error)
        {
          return {ExitStatus::interrupted, error.what()};
        }
      catch (const FailedElsewhere &error)
        {
          return error.failure;
        }
      catch (const dealii::ExceptionBase &error)
        {
          return describe(error);
        }
      catch (const std::filesystem::filesystem_error &error)
        {
          return {ExitStatus::bad_files, error.what()};
        }
      catch (const std::ios_base::failure &error)
        {
          return {ExitStatus::bad_files, error.what()};
        }
      catch (const std::bad_alloc &)
        {
          // Like a full disk.
          return {ExitStatus::bad_files,
                  "The machine's memory is used up; take fewer particles or "
                  "cells, or fewer ranks."};
        }
      catch (const std::exception &error)
        {
          return {ExitStatus::fault,
                  std::string("A fault inside of the program: ") +
                      error.what()};
        }
      catch (...)
        {
          return {ExitStatus::fault, "A fault inside of the program."};
        }
    }


    /// Whether all ranks come here within two seconds.
    bool
    all_ranks_arrive(const MPI_Comm communicator)
    {
      MPI_Request request;
      if (MPI_Ibarrier(communicator, &request) != MPI_SUCCESS)
        return false;
      for (unsigned int i = 0; i < 200; ++i)
        {
          int done = 0;
          if (MPI_Test(&request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS)
            return false;
          if (done)
            return true;
          std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
      return false;
    }


    int
    report(const Failure &failure, const MPI_Comm communicator)
    {
      const unsigned int rank =
          dealii::Utilities::MPI::this_mpi_process(communicator);
      const bool together =
          dealii::Utilities::MPI::n_mpi_processes(communicator) == 1 ||
          all_ranks_arrive(communicator);
      const std::string prefix =
          together ? "morsel: " : "morsel: rank " + std::to_string(rank) + ": ";
      std::istringstream sentences(presentable(failure.sentence));
      if (rank == 0 || !together)
        for (std::string line; std::getline(sentences, line);)
          std::cerr << prefix << line << std::endl;
      if (!together)
        MPI_Abort(communicator, static_cast<int>(failure.status));
      return static_cast<int>(failure.status);
    }
  } // namespace


  int
  exit_status_of(const std::function<void()> &work)
  {
    dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();

    // A communicator of its own, for nothing that was left unfinished on
    // others can disturb it.
    MPI_Comm communicator = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &communicator);
    int status = static_cast<int>(ExitStatus::done);
    try
      {
        work();
      }
    catch (...)
      {
        // The first rank that ends has mpirun send SIGTERM to the others, who
        // would speak of an interruption beside the failure.
        catch_signals();
        status = report(describe_current_exception(), communicator);
      }
    MPI_Comm_free(&communicator);
    return status;
  }


  bool
  FirstRank::is_this_rank() const
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }


  void
  FirstRank::run(const std::function<void()> &work) const
  {
    int                status = static_cast<int>(ExitStatus::done);
    std::exception_ptr exception;
    if (is_this_rank())
      try
        {
          work();
        }
      catch (...)
        {
          exception = std::current_exception();
          status    = static_cast<int>(describe_current_exception().status);
        }
    MPI_Bcast(&status, 1, MPI_INT, 0, MPI_COMM_WORLD);
    if (exception)
      std::rethrow_exception(exception);
    if (status != static_cast<int>(ExitStatus::done))
      throw FailedElsewhere{{static_cast<ExitStatus>(status), ""}};
  }


  void
  run_on_all_ranks(const MPI_Comm               communicator,
                   const std::function<void()> &work)
  {
    Failure            failure{ExitStatus::done, ""};
    std::exception_ptr exception;
    try
      {
        work();
      }
    catch (...)
      {
        exception = std::current_exception();
        failure   = describe_current_exception();
      }
    const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int speaker = dealii::Utilities::MPI::min(
        exception ? dealii::Utilities::MPI::this_mpi_process(communicator)
                  : n_ranks,
        communicator);
    if (speaker == n_ranks)
      return;
    int status = static_cast<int>(failure.status);
    int length = failure.sentence.size();
    MPI_Bcast(&status, 1, MPI_INT, speaker, communicator);
    MPI_Bcast(&length, 1, MPI_INT, speaker, communicator);
    std::string sentence = failure.sentence;
    sentence.resize(length);
    MPI_Bcast(sentence.data(), length, MPI_CHAR, speaker, communicator);
    if (exception)
      std::rethrow_exception(exception);
    throw FailedElsewhere{{static_cast<ExitStatus>(status), sentence}};
  }
} // namespace Morsel
