#include <catch2/catch.hpp>

#include "coupler/c_api/descriptions.hpp"
#include "coupler/c_api/given.hpp"

using namespace talus;

namespace {

/// The same struct in three versions of a header.
struct Older {
  std::size_t size;
  int count;
  int kind;
};
struct Present {
  std::size_t size;
  int count;
  int kind;
  double length;
};
struct Newer {
  std::size_t size;
  int count;
  int kind;
  double length;
  double width;
};

template <class Struct>
const Present* as_present(const Struct& said) {
  return reinterpret_cast<const Present*>(&said);
}

}  // namespace

TEST_CASE("a struct of an older header counts as zero where it has no members") {
  const struct {
    Older said;
    double not_its_own;
  } memory{{.size = sizeof(Older), .count = 3, .kind = 1}, 7.0};
  const Present taken = c_api::taken(as_present(memory.said), "part");
  CHECK(taken.count == 3);
  CHECK(taken.kind == 1);
  CHECK(taken.length == 0);
}

TEST_CASE("a struct of a newer header is taken while it asks for nothing new, and refused where it does") {
  Newer said{.size = sizeof(Newer), .count = 3, .kind = 1, .length = 0.5, .width = 0};
  CHECK(c_api::taken(as_present(said), "part").length == 0.5);
  said.width = 0.1;
  CHECK_THROWS_WITH(c_api::taken(as_present(said), "part"),
                    "part sets a member that this version of libtalus_c does not know");
}

TEST_CASE("filling a struct of an older header leaves what stands behind it as it is") {
  struct {
    Older said;
    double not_its_own;
  } memory{{.size = sizeof(Older), .count = 0, .kind = 0}, 7.0};
  c_api::fill(reinterpret_cast<Present*>(&memory.said), "part",
              {.size = 0, .count = 3, .kind = 1, .length = 2});
  CHECK(memory.said.size == sizeof(Older));
  CHECK(memory.said.count == 3);
  CHECK(memory.not_its_own == 7.0);
}

TEST_CASE("filling a struct of a newer header sets what this version does not know to zero") {
  Newer said{.size = sizeof(Newer), .count = 0, .kind = 0, .length = 0, .width = 9};
  c_api::fill(const_cast<Present*>(as_present(said)), "part",
              {.size = 0, .count = 3, .kind = 1, .length = 2});
  CHECK(said.size == sizeof(Newer));
  CHECK(said.length == 2);
  CHECK(said.width == 0);
}

TEST_CASE("a struct whose size was never set is refused with the size it should have") {
  Present said{};
  CHECK_THROWS_WITH(c_api::taken(&said, "part"),
                    "the size of part is 0; set it to sizeof(part), which is 24");
  said.size = 0xdeadbeef;
  CHECK_THROWS_AS(c_api::taken(&said, "part"), core::UsageError);
}

TEST_CASE("calls in C name the member that is missing or cannot be") {
  const double positions[3] = {};
  talus_surface surface{};
  surface.nodes = 1;
  CHECK_THROWS_WITH(c_api::surface_from(surface, {}), "talus_surface.positions is NULL");
  surface.positions = positions;
  surface.triangles = -2;
  CHECK_THROWS_WITH(c_api::surface_from(surface, {}), "talus_surface.triangle_nodes: -2 of them cannot be");
  talus_limit limit{};
  limit.size = sizeof limit;
  CHECK_THROWS_WITH(c_api::limit_from(&limit), "talus_limit.name is NULL; a text is expected");
  talus_group group{};
  group.size = sizeof group;
  group.corners = 4;
  CHECK_THROWS_WITH(c_api::group_from(&group), Catch::StartsWith("talus_group.corners is 4"));
  CHECK_THROWS_AS(c_api::limit_from(nullptr), core::UsageError);
}
