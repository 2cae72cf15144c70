#include "coupler/participant.hpp"

namespace talus::coupler {

/// Nothing else in libtalus_participant asks for what stands in participant.hpp, and of archives the linker takes only
/// what is asked for.
[[gnu::used]] const auto what_the_library_is_for = &take_part;

}  // namespace talus::coupler
