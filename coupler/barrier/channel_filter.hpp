#pragma once

#include <span>
#include <vector>

namespace talus::barrier {

/// Low pass without phase shift for measured accelerations: a channel frequency class (CFC) after ISO 6487 and SAE J211,
/// a Butterworth filter of second order run forwards and backwards.
///
///     w_d = 2 pi CFC 2.0775      w_a = tan(w_d T/2)
///     y_i = b0 x_i + b1 x_(i-1) + b2 x_(i-2) + a1 y_(i-1) + a2 y_(i-2)
///     b0 = w_a^2/(1 + sqrt(2) w_a + w_a^2),  b1 = 2 b0,  b2 = b0
///     a1 = -2 (w_a^2 - 1)/(1 + sqrt(2) w_a + w_a^2),  a2 = (-1 + sqrt(2) w_a - w_a^2)/(1 + sqrt(2) w_a + w_a^2)
///
/// | symbol | variable | meaning                                               | unit |
/// |--------|----------|-------------------------------------------------------|------|
/// | CFC    | channel_class | 60, 180, 600, 1000; the corner lies at 1.65 times it | Hz |
/// | T      | interval | between samples; at most 1/(10 CFC) for a true filter | s    |
///
/// Proven by (barrier_test.cpp): "a channel filter lets slow motion pass, damps fast motion and moves nothing in time".
std::vector<double> channel_filtered(std::span<const double> samples, double interval, double channel_class);

}  // namespace talus::barrier
