#include "coupler/coupler_watch.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>

#include "core/errors.hpp"
#include "core/program/log.hpp"
#include "coupler/pause.hpp"

namespace talus::coupler {
namespace {

using namespace std::chrono_literals;

constexpr auto between_looks = 250ms, grace = 500ms;

}  // namespace

CouplerWatch::CouplerWatch(const transport::ProcessIdentity& coupler, const char* role)
    : thread_([handle = transport::ProcessHandle(coupler), role](const std::stop_token& stop) {
        while (handle.alive())
          if (!paused(stop, between_looks)) return;
        if (!paused(stop, grace)) return;
        core::log_error(fmt::format("the coupler (pid {}) died while {} was computing", handle.pid(), role));
        _exit(static_cast<int>(core::ExitCode::transport));
      }) {}

}  // namespace talus::coupler
