#pragma once

#include <string>

/// Signals that ask a run to end with everything written: Ctrl-C (SIGINT), SIGTERM, SIGHUP, SIGUSR1, SIGUSR2.
/// `timeout`, a batch system and a terminal that is closed send them to all processes of a run at once.
namespace talus::core {

/// From here on they only set a flag, and say at once on the standard error stream that and when the program
/// stops. A second Ctrl-C, half a second or more after the first, ends the program at once. SIGHUP
/// stays ignored where it was (nohup). A pipe that nobody reads any more is an error of a write, no signal.
/// @param when a literal: "at the end of this window"
void watch_stop_signals(const char* when);
bool stop_requested() noexcept;
/// "stopped by SIGTERM"; empty where nobody asked.
std::string stop_reason();

/// For a program whose end another one decides.
void ignore_stop_signals();

}  // namespace talus::core
