#pragma once

/// Ctrl-C and SIGTERM ask a run to end at the next step, with everything written.
namespace talus::core {

/// From here on the first SIGINT or SIGTERM only sets the flag; a second one ends the program at once.
void watch_stop_signals();
bool stop_requested() noexcept;
/// For a program that another one stops: Ctrl-C in a terminal reaches both, and only the commander is to act
/// on it.
void ignore_interrupts();

}  // namespace talus::core
