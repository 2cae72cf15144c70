#include "core/parallel.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/errors.hpp"
#include "core/vector3.hpp"

namespace talus {
namespace {

std::vector<double> random_numbers(std::size_t count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-12, 12);
  std::vector<double> numbers(count);
  for (auto& number : numbers) number = std::pow(10, exponent(random)) * (random() % 2 ? 1 : -1);
  return numbers;
}

}  // namespace

TEST_CASE("a sum has the same bits for 1, 2, 3, 4 and 7 threads") {
  const auto numbers = random_numbers(100003);
  const auto count = static_cast<std::int64_t>(numbers.size());
  const auto sum = [&] {
    core::OrderedSum ordered;
    return ordered(count, 0.0, [&](std::int64_t i) { return numbers[static_cast<std::size_t>(i)]; });
  };
  core::set_thread_count(1);
  const double expected = sum();
  for (const int threads : {2, 3, 4, 7}) {
    core::set_thread_count(threads);
    for (int repeat = 0; repeat < 20; ++repeat) CHECK(sum() == expected);
  }
  core::set_thread_count(1);
}

TEST_CASE("a sum of integers is exact, also over no items and over vectors") {
  core::set_thread_count(2);
  core::OrderedSum sum;
  for (const std::int64_t count : {0, 1, 511, 512, 513, 10000})
    CHECK(sum(count, 0.0, [](std::int64_t i) { return static_cast<double>(i); }) ==
          static_cast<double>(count * (count - 1) / 2));
  core::OrderedSum<core::Vector3> vectors;
  const core::Vector3 total = vectors(1000, core::Vector3::Zero(), [](std::int64_t i) {
    return core::Vector3(1, static_cast<double>(i), 0);
  });
  CHECK(total == core::Vector3(1000, 499500, 0));
  core::set_thread_count(1);
}

TEST_CASE("a loop visits every item once, in blocks that do not depend on the number of threads") {
  for (const int threads : {1, 2, 4}) {
    core::set_thread_count(threads);
    for (const std::int64_t count : {0, 1, 512, 5000}) {
      std::vector<int> visits(static_cast<std::size_t>(count));
      core::parallel_for(count, [&](std::int64_t i) { ++visits[static_cast<std::size_t>(i)]; });
      CHECK(std::all_of(visits.begin(), visits.end(), [](int v) { return v == 1; }));
    }
    std::vector<std::int64_t> begins(3);
    core::parallel_blocks(
        25,
        [&](core::Block block, std::int64_t index) { begins[static_cast<std::size_t>(index)] = block.begin; },
        10);
    CHECK(begins == std::vector<std::int64_t>{0, 10, 20});
  }
  core::set_thread_count(1);
}

TEST_CASE("no threads are too few") {
  CHECK_THROWS_AS(core::set_thread_count(0), core::UsageError);
}

}  // namespace talus
