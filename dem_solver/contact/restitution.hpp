#pragma once

/// Damping that gives exactly the restitution asked for.
namespace talus::dem {

/// Ratio of rebound to approach speed of a mass on a spring and dashpot whose force ends when it would start
/// to pull.
///
/// x'' + 2 z x' + x = 0, x(0) = 0, x'(0) = 1 leaves contact when x'' = 0 for the first time, at t = 2 acos(z)
/// / sqrt(1 - z^2), with the speed
///     e = exp(-2 z acos(z) / sqrt(1 - z^2))            for z < 1, and with acosh and z^2 - 1 for z > 1
/// (the same as Schwager and Pöschel, Granular Matter 9 (2007) 465, eq. 21, whose cases this writes as one).
///     z · damping_ratio · damping over critical damping · 1 · >= 0
/// Test: "A damped oscillator that may not pull rebounds as its integrated motion does".
double oscillator_restitution(double damping_ratio) noexcept;

/// The inverse of oscillator_restitution. @pre 0 < restitution <= 1
double oscillator_damping_ratio(double restitution) noexcept;

/// Damping ratio g of the dashpot 2 g sqrt(m kn) that gives `restitution` with the Hertz spring, kn = 2 E
/// sqrt(R d).
///
/// With X = d^(5/4) and dT = d^(1/4) dt the Hertz collision  d'' = -d^(3/2) - 2 g sqrt(3/2) d^(1/4) d'
/// becomes the linear X_TT + 2 g sqrt(3/2) X_T + 5/4 X = 0 (Antypov and Elliott, EPL 94 (2011) 50004), so its
/// ratio is z = g sqrt(6/5) and the rebound that of the oscillator, whatever the speed, size and stiffness.
/// Test: "Restitution of a Hertz contact is the one asked for at any speed, size and stiffness". @pre 0 <
/// restitution <= 1
double hertz_damping_ratio(double restitution) noexcept;

}  // namespace talus::dem
