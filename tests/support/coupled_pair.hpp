#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "coupler/schemes/exchange.hpp"
#include "coupler/session/introduction.hpp"
#include "tests/support/in_process.hpp"

namespace talus::test {

/// Two participants in threads of this process, introduced and ready for windows of these lengths.
class CoupledPair {
 public:
  CoupledPair(ParticipantThread::Serve structure, ParticipantThread::Serve particles,
              const coupler::WindowLengths& windows, coupler::Order order = coupler::Order::iterated) {
    session_.await(coupler::Role::structure);
    session_.await(coupler::Role::particles);
    threads_[0] =
        std::make_unique<ParticipantThread>(segment_, coupler::Role::structure, std::move(structure));
    threads_[1] =
        std::make_unique<ParticipantThread>(segment_, coupler::Role::particles, std::move(particles));
    session_.wait_joined();
    interface_ = coupler::introduce(session_, coupler::identical_surfaces());
    coupler::lay_out_arrays(session_, interface_, windows, order);
    exchange_.emplace(session_, interface_->tie.mapping);
  }
  ~CoupledPair() { session_.abort("the test is over"); }

  coupler::Session& session() { return session_; }
  coupler::Exchange& exchange() { return *exchange_; }
  /// z of the structure's node.
  double displacement() { return exchange_->structure().displacement[2]; }
  double velocity() { return exchange_->structure().velocity[2]; }

 private:
  std::shared_ptr<coupler::transport::Segment> segment_ = coupler::transport::create_heap_segment();
  std::array<std::unique_ptr<ParticipantThread>, 2> threads_;
  coupler::Session session_{segment_, {}};
  std::optional<coupler::Interface> interface_;
  std::optional<coupler::Exchange> exchange_;
};

}  // namespace talus::test
