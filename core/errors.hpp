#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

/// The ways a run can fail, apart because a different person has to act. Assertions are for our own bugs.
namespace talus::core {

/// Exit codes of every Talus program.
enum class ExitCode : int {
  success = 0,
  bug = 1,          ///< an exception nobody expected
  config = 2,       ///< ConfigError or a wrong command line
  transport = 3,    ///< TransportError
  numerical = 4,    ///< NumericalError
  interrupted = 5,  ///< Ctrl-C, SIGTERM or the like; everything is written
  regression = 6,   ///< a regression or study found a difference
  machine = 7,      ///< MachineError: disk, memory, permission
};
/// All of them with their meanings, a line each, for help pages.
std::string exit_code_help();

/// One complaint about a scene, tied to the place in the file it speaks of.
struct Complaint {
  std::string file = {};
  int line = 0;               ///< from 1; 0: the file as a whole
  int column = 0;             ///< from 1; 0: the line as a whole
  std::string key_path = {};  ///< "structure.parts.net.area"; empty for the file as a whole
  std::string message = {};   ///< one sentence: what is wrong, the value, what was expected
  bool warning = false;       ///< a value to look at; the scene is read all the same

  /// "scene.yaml:12:5: structure.parts.net.area: must be greater than 0 m^2, but is -1 m^2"
  std::string text() const;
  bool operator==(const Complaint&) const = default;
};

/// The user's scene or command line is wrong; raised before time 0, with every complaint found.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(std::vector<Complaint> complaints);
  explicit ConfigError(const std::string& message);  ///< a complaint about no place in a file
  const std::vector<Complaint>& complaints() const { return complaints_; }

 private:
  std::vector<Complaint> complaints_;
};

/// A caller of a public interface broke its contract (called out of order, wrong sizes).
class UsageError : public std::logic_error {
  using std::logic_error::logic_error;
};

/// A peer died, hung, lied about its layout or went silent.
class TransportError : public std::runtime_error {
 public:
  struct Details {
    std::string peer;                    ///< "structure (fem_solver, pid 1234)"
    std::string waited_for;              ///< "the answer to 'advance'"
    std::int64_t window = -1;            ///< the window in progress; -1 before the first
    std::string reason;                  ///< "was killed by signal 9 (SIGKILL)"
    std::string waiter = "the coupler";  ///< who waited
  };
  explicit TransportError(Details details);
  const Details& details() const { return details_; }

 private:
  Details details_;
};

/// The computation broke down: not finite, not converged, step floor reached.
class NumericalError : public std::runtime_error {
 public:
  struct Details {
    std::string what;    ///< "displacement is not finite"
    std::string entity;  ///< "node 17 of net at (1.5, 1.5, 0) m"
    std::int64_t step = -1;
    double time = 0;  ///< s
    double value = 0;
    std::optional<double> last_output_time =
        {};  ///< s; whose output is the last good one; < 0: none; absent: not known
  };
  explicit NumericalError(Details details);
  const Details& details() const { return details_; }

 private:
  Details details_;
};

/// The machine does not give what a run needs: memory, shared memory, room on a disk.
class MachineError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file cannot be made, written or replaced: the disk is full or broken, the folder read-only, a permission
/// missing.
class FileError : public MachineError {
 public:
  using MachineError::MachineError;
  /// "'results/net/probes.csv' cannot be written: No space left on device"
  /// @param error as errno has it
  FileError(const std::filesystem::path& path, const std::string& action, int error);
};

/// The exit code a program ends with when `error` reaches main().
ExitCode exit_code(const std::exception& error) noexcept;

}  // namespace talus::core
