#pragma once

/// Sizes as a set of sieves sorts them: the openings are the preferred numbers R 10 of ISO 3, which ISO 565
/// takes for sieves: 1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8 times powers of ten, each about a quarter more
/// than the one before.
namespace talus::dem {

/// m; of the sieve with this number: 0 is 1 m, 1 is 1.25 m, -1 is 0.8 m.
double sieve_opening(int number) noexcept;

/// The number of the widest sieve that a stone of this diameter (m, > 0) does not fall through.
int sieve_that_holds(double diameter) noexcept;

}  // namespace talus::dem
