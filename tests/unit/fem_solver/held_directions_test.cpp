#include "fem_solver/constraints/held_directions.hpp"

#include <catch2/catch.hpp>

#include "fem_solver/integration/explicit.hpp"
#include "tests/support/structures.hpp"

using namespace talus::fem;
namespace tests = talus::tests;
using Catch::Contains;

TEST_CASE("a direction that two supports hold is held once, and its force is the first one's reaction") {
  Model model = tests::chain<BarBatch>(tests::steel, 1, 1);
  model.supports = {tests::fixed({0}), tests::fixed({0, 1})};
  model.loads = {tests::load(1, {500, 0, 0})};
  const auto held = held_directions(model);
  CHECK(held.size() == 6);
  CHECK(held[0].support == &model.supports[0]);
  CHECK(held[3].support == &model.supports[1]);
  CHECK(held[3].direction == 3);
  CHECK(held[3].reaction == 6);  // behind the three of the first support and those of its own first node
  Assembly assembly(model);
  ExplicitSolver solver(model, assembly, 1e-6);
  solver.advance(0, 1e-5);
  double sum = 0;
  for (std::size_t i = 0; i < solver.reactions().size(); i += 3) sum += solver.reactions()[i];
  CHECK(sum == Approx(-500));  // twice that where both supports count it
}

TEST_CASE("supports that lead a node to different places are refused, with the node and the direction") {
  Model model = tests::chain<BarBatch>(tests::steel, 1, 1);
  model.supports = {tests::fixed({0}), tests::fixed({0})};
  model.supports[0].name = "anchors";
  model.supports[1].name = "jack";
  model.supports[1].displacement = Vector3(0, 0, 0.1);
  CHECK_THROWS_WITH(held_directions(model),
                    Contains("anchors and jack give node 0") && Contains("different motions along z"));
  model.supports[0].displacement = model.supports[1].displacement;
  CHECK(held_directions(model).size() == 3);
  model.supports[0].history.points = {{0, 0}, {1, 1}};
  CHECK_THROWS_WITH(held_directions(model), Contains("along z"));
  // A table says nothing of a direction that does not move: two that hold it still agree, whatever their tables.
  model.supports[0].displacement = model.supports[1].displacement = Vector3::Zero();
  CHECK(held_directions(model).size() == 3);
}

TEST_CASE("a node counts as held where supports take all of its directions, by one or by several") {
  Model model = tests::chain<BarBatch>(tests::steel, 1, 2);
  model.supports = {tests::fixed({0}), tests::fixed({1, 2}, {true, true, false}),
                    tests::fixed({1}, {false, false, true})};
  CHECK(held_nodes(model) == std::vector<bool>{true, true, false});
}
