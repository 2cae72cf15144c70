#include "coupler/schemes/commands.hpp"

namespace talus::coupler {

Command command_at(const Window& window, Action action) {
  return {.action = action,
          .window = window.regular_index(),
          .time = window.start(),
          .length = window.length(),
          .regular_length = window.regular_length()};
}

Command advance(const Window& window, std::optional<int> iteration) {
  Command command = command_at(window, Action::advance);
  command.tentative = iteration.has_value();
  command.iteration = iteration.value_or(0);
  return command;
}

}  // namespace talus::coupler
