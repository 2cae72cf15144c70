#include <cstdlib>

#include "core/output/result_writer.hpp"
#include "tests/support/moving_net.hpp"

/// Writes a result of three frames to the folder given, for the ParaView test.
int main(int count, char** arguments) {
  if (count != 2) return EXIT_FAILURE;
  talus::test::MovingNet net(4, "net"), sheet(3, "sheet");
  talus::core::ResultWriter writer(
      {.folder = arguments[1], .existing = talus::core::ResultFolder::Existing::replace, .frame_capacity = 5},
      {&net, &sheet});
  for (const double time : {0.0, 0.1, 0.2}) {
    net.frame = sheet.frame = 10 * time;
    writer.write_row(time);
    writer.write_fields(time);
  }
  writer.finish(talus::core::RunStatus::finished);
}
