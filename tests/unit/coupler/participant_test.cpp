#include "coupler/participant.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <limits>
#include <thread>

#include "core/errors.hpp"
#include "coupler/channel_participant.hpp"
#include "coupler/schemes/serial_explicit.hpp"
#include "coupler/session/introduction.hpp"
#include "tests/support/coupled_pair.hpp"
#include "tests/support/in_process.hpp"
#include "tests/support/two_masses.hpp"

using namespace talus;
using namespace talus::coupler;
using Catch::Matchers::Contains;

namespace {

/// A coupler that introduces participants and sends them `commands`, then the end.
struct Coupler {
  std::shared_ptr<transport::Segment> segment = transport::create_heap_segment();
  Session session{segment, {}};

  void introduce_all() {
    session.wait_joined();
    const auto interface = introduce(session, identical_surfaces());
    lay_out_arrays(session, interface, {1e-3});
  }
};

}  // namespace

TEST_CASE("calls out of order are usage errors that name both calls") {
  Coupler coupler;
  coupler.session.await(Role::structure);
  std::string early_next, twice, early_fields, early_answer;
  const auto message_of = [](auto&& call) {
    try {
      call();
    } catch (const core::UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  {
    const test::ParticipantThread thread(coupler.segment, Role::structure, [&](Participant& p) {
      early_next = message_of([&] { p.next(); });
      early_fields = message_of([&] { p.structure_fields(); });
      p.publish_surface(test::one_node(), std::array{1.0});
      twice = message_of([&] { p.publish_surface(test::one_node(), std::array{1.0}); });
      p.declare({.program = "test"});
      early_answer = message_of([&] { p.answer(); });
      p.next();
    });
    coupler.introduce_all();
    coupler.session.finish();
  }
  CHECK_THAT(early_next, Contains("next() may not follow join()"));
  CHECK_THAT(early_fields, Contains("exist from the first next() on"));
  CHECK_THAT(twice, Contains("publish_surface() may not follow"));
  CHECK_THAT(early_answer, Contains("answer() may not follow declare()"));
}

TEST_CASE("masses that do not fit the surface are a usage error") {
  Coupler coupler;
  coupler.session.await(Role::structure);
  const test::ParticipantThread thread(coupler.segment, Role::structure, [](Participant& p) {
    p.publish_surface(test::one_node(), std::array{1.0, 2.0});
  });
  CHECK_THROWS_WITH(coupler.introduce_all(), Contains("2 masses for 1 nodes"));
}

TEST_CASE("a surface larger than the mailbox arrives whole at the other side") {
  mesh::Surface surface;
  constexpr int nodes = 20000;  // 480 kB, several mailboxes
  for (int i = 0; i < nodes; ++i) {
    surface.positions.insert(surface.positions.end(), {0.1 * i, 0, 0});
    if (i > 0) surface.segments.push_back({i - 1, i});
  }
  surface.parts = {{.name = "line", .segment_end = nodes - 1}};
  mesh::Surface received;
  std::vector<double> masses;
  Coupler coupler;
  coupler.session.await(Role::structure);
  coupler.session.await(Role::particles);
  {
    const test::ParticipantThread structure(coupler.segment, Role::structure, [&](Participant& p) {
      p.publish_surface(surface, std::vector<double>(nodes, 0.5));
      p.declare({.program = "test"});
      p.next();
    });
    const test::ParticipantThread particles(coupler.segment, Role::particles, [&](Participant& p) {
      received = p.receive_surface(masses);
      p.declare({.program = "test"});
      p.next();
    });
    coupler.introduce_all();
    coupler.session.finish();
  }
  CHECK(received == surface);
  CHECK(masses == std::vector<double>(nodes, 0.5));
}

TEST_CASE("complaints of both sides and of the coupler come out together, sorted by place, each once") {
  Coupler coupler;
  coupler.session.await(Role::structure);
  coupler.session.await(Role::particles);
  const auto refuse = [](std::vector<core::Complaint> complaints) {
    return [complaints](Participant&) { throw core::ConfigError(complaints); };
  };
  const core::Complaint common{"s.yaml", 3, 1, "time", "is missing"};
  const core::Complaint first{"s.yaml", 1, 1, "structure", "is odd"},
      second{"s.yaml", 9, 1, "particles", "are few"};
  const test::ParticipantThread structure(coupler.segment, Role::structure, refuse({common, first}));
  const test::ParticipantThread particles(coupler.segment, Role::particles, refuse({second, common}));
  coupler.session.wait_joined();
  try {
    introduce(coupler.session, identical_surfaces(), {common});
    FAIL("not refused");
  } catch (const core::ConfigError& error) {
    CHECK(error.complaints() == std::vector<core::Complaint>{first, common, second});
  }
}

TEST_CASE("a coupler that is busy for longer than a participant's patience is not given up") {
  Coupler coupler;
  coupler.session.await(Role::structure);
  std::string message = "none";
  std::jthread thread([&] {
    // Two beats of the coupler fall into its patience.
    ChannelParticipant p(coupler.segment, {.segment = "", .role = Role::structure, .timeout = 1});
    try {
      p.publish_surface({}, {});
      p.declare({.program = "test"});
      p.next();
    } catch (const std::exception& error) {
      message = error.what();
    }
  });
  coupler.introduce_all();
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // as if it wrote a large file
  coupler.session.finish();
  thread.join();
  CHECK(message == "none");
}

TEST_CASE("a participant is told why the coupler ends the run") {
  std::string message;
  auto coupler = std::make_unique<Coupler>();
  coupler->session.await(Role::structure);
  const test::ParticipantThread thread(coupler->segment, Role::structure, [&](Participant& p) {
    try {
      p.publish_surface(test::one_node(), std::array{1.0});
      p.declare({.program = "test"});
      p.next();
    } catch (const core::TransportError& error) {
      message = error.what();
    }
  });
  coupler->introduce_all();
  coupler->session.abort("the disk is full");
  CHECK_THAT(message, Contains("ended the run: the disk is full"));
}

TEST_CASE("of two failures of a participant the coupler hears the first") {
  Coupler coupler;
  coupler.session.await(Role::structure);
  const test::ParticipantThread thread(coupler.segment, Role::structure, [&](Participant& p) {
    p.fail(std::runtime_error("no licence"));
    p.fail(std::runtime_error("gone"));
  });
  CHECK_THROWS_WITH(coupler.introduce_all(), Contains("no licence") && !Contains("gone"));
}

TEST_CASE(
    "a value that is no number is refused where it is handed over, and named with side, field, node and "
    "window") {
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  const bool of_structure = GENERATE(true, false);
  constexpr std::int64_t fault = 3;
  const auto serve = [&](Participant& p, bool is_structure) {
    for (auto command = p.next(); command.action != Action::finish; command = p.next()) {
      if (command.action == Action::advance && command.window == fault && is_structure == of_structure)
        (is_structure ? p.structure_fields().velocity : p.particle_fields().force)[2] = bad;
      p.answer();
    }
  };
  test::CoupledPair pair(
      [&](Participant& p) {
        p.publish_surface(test::one_node(), std::array{1.0});
        p.declare({.program = "test"});
        serve(p, true);
      },
      [&](Participant& p) {
        std::vector<double> masses;
        p.receive_surface(masses);
        p.declare({.program = "test"});
        serve(p, false);
      },
      {1e-3}, Order::in_turn);
  const auto run = [&] {
    for (int n = 0; n < 10; ++n) SerialExplicit{}.compute(pair.exchange(), {.index = n, .unit = 1e-3});
  };
  CHECK_THROWS_WITH(run(), Contains(of_structure ? "the structure handed over a value that is not finite"
                                                 : "the particles handed over a value that is not finite") &&
                               Contains(of_structure ? "z velocity of node 0" : "z force of node 0") &&
                               Contains("in window 3"));
}
