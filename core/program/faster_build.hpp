#pragma once

/// Programs that run on any x86-64, beside copies of them for newer processors.
namespace talus::core {

/// Where this program is built for any x86-64, the processor has x86-64-v3 (AVX2, FMA), and a copy for that stands in
/// ../lib/talus/x86-64-v3/bin/, seen from the folder of this program: becomes that copy, with the same arguments. Else does
/// nothing. The environment's TALUS_CPU=x86-64 keeps the program as it is. To be called first in main().
void become_faster_build(const char* const* arguments) noexcept;

}  // namespace talus::core
