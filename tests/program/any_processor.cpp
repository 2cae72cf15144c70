#include <cstdio>

#include "core/program/faster_build.hpp"

/// A program for any x86-64, as the Debian package has them. For faster_build_test.py.
int main(int, char** argv) {
  talus::core::become_faster_build(argv);
  std::puts("for any");
}
