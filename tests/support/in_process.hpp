#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "coupler/channel_participant.hpp"
#include "coupler/transport/segment.hpp"

namespace talus::test {

/// A participant in a thread of the test. What it throws is told to the coupler, as a program's main() would.
class ParticipantThread {
 public:
  using Serve = std::function<void(coupler::Participant&)>;

  ParticipantThread(std::shared_ptr<coupler::transport::Segment> segment, coupler::Role role, Serve serve)
      : thread_([segment = std::move(segment), role, serve = std::move(serve)] {
          const auto participant = coupler::join_in_process(segment, role);
          try {
            serve(*participant);
          } catch (const std::exception& error) {
            participant->fail(error);
          }
        }) {}
  ~ParticipantThread() { thread_.join(); }

 private:
  std::thread thread_;
};

}  // namespace talus::test
