#include <catch2/catch.hpp>

#include "dem_solver/boundary/boundary_list.hpp"

using namespace talus;
using namespace talus::dem;

namespace {

/// The scene's own wire and face, then two wires and a face that were received.
Boundary own_and_received() {
  mesh::Surface surface{.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0},
                        .segments = {{0, 1}, {3, 4}, {4, 5}},
                        .triangles = {{0, 1, 2}, {3, 4, 5}}};
  surface.parts = {
      {.name = "own", .segment_end = 1, .triangle_end = 1},
      {.name = "net", .segment_begin = 1, .segment_end = 3, .triangle_begin = 1, .triangle_end = 2}};
  return Boundary(surface, std::vector<Index>{0, 0});
}
constexpr Boundary::Cells received{.first_segment = 1, .segments = 2, .first_triangle = 1};

std::vector<bool> lost_features(const Boundary& boundary) {
  std::vector<bool> lost;
  for (std::size_t f = 0; f < boundary.features().size(); ++f)
    lost.push_back(boundary.is_lost(static_cast<Index>(f)));
  return lost;
}

}  // namespace

TEST_CASE("a cell that is lost is that of the received surface, never one of the scene's own") {
  Boundary boundary = own_and_received();
  boundary.lose(received, std::vector<double>{0, 1, 1});
  CHECK(lost_features(boundary) == std::vector<bool>{false, false, false, true, true});
  boundary.lose(received, std::vector<double>{1, 0, 0});  // a window was taken back, and went another way
  CHECK(lost_features(boundary) == std::vector<bool>{false, false, true, false, false});
}

TEST_CASE("losses are counted where they change, and cost nothing where there are none") {
  Boundary boundary = own_and_received();
  boundary.lose(received, std::vector<double>{0, 0, 0});
  CHECK(boundary.losses() == 0);
  boundary.lose(received, std::vector<double>{0, 1, 0});
  boundary.lose(received, std::vector<double>{0, 1, 0});
  CHECK(boundary.losses() == 1);
  boundary.lose(received, std::vector<double>{0, 0, 0});
  CHECK(boundary.losses() == 2);
}
