#pragma once

namespace talus::fem {

/// The structural solver's main(): on its own, or coupled with `--join`. A program with elements of its own calls
/// add_user_element() before it.
int run_program(int argc, char** argv);

}  // namespace talus::fem
