#include "dem_solver/rocks/rotation.hpp"

namespace talus::dem {

namespace {
Triple<double> vector_part(const Quaternion& q) noexcept {
  return {q.x, q.y, q.z};
}
}  // namespace

Quaternion product(const Quaternion& a, const Quaternion& b) noexcept {
  const Triple<double> u = vector_part(a), v = vector_part(b);
  const Triple<double> w = a.w * v + b.w * u + cross(u, v);
  return {w.x, w.y, w.z, a.w * b.w - dot(u, v)};
}

Triple<double> rotate(const Quaternion& q, const Triple<double>& v) noexcept {
  const Triple<double> t = 2.0 * cross(vector_part(q), v);
  return v + q.w * t + cross(vector_part(q), t);
}

Triple<double> rotate_back(const Quaternion& q, const Triple<double>& v) noexcept {
  return rotate({-q.x, -q.y, -q.z, q.w}, v);
}

Triple<double> angular_velocity(const Quaternion& q, const Triple<double>& momentum,
                                const Triple<double>& moments) noexcept {
  const Triple<double> body = rotate_back(q, momentum);
  return rotate(q, {body.x / moments.x, body.y / moments.y, body.z / moments.z});
}

namespace {

/// Turns about one body axis by the angle that the momentum along it asks for in `time`.
template <double Triple<double>::*axis>
Quaternion turn_about(const Quaternion& q, const FreeTurn& turn, double time) noexcept {
  const double half = 0.5 * time * rotate_back(q, turn.momentum).*axis / (turn.moments.*axis);
  Triple<double> direction{};
  direction.*axis = std::sin(half);
  return product(q, {direction.x, direction.y, direction.z, std::cos(half)});
}

}  // namespace

Quaternion turned(const Quaternion& q, const FreeTurn& turn) noexcept {
  Quaternion r = turn_about<&Triple<double>::x>(q, turn, 0.5 * turn.step);
  r = turn_about<&Triple<double>::y>(r, turn, 0.5 * turn.step);
  r = turn_about<&Triple<double>::z>(r, turn, turn.step);
  r = turn_about<&Triple<double>::y>(r, turn, 0.5 * turn.step);
  r = turn_about<&Triple<double>::x>(r, turn, 0.5 * turn.step);
  const double scale = 1 / std::sqrt(r.x * r.x + r.y * r.y + r.z * r.z + r.w * r.w);
  return {scale * r.x, scale * r.y, scale * r.z, scale * r.w};
}

}  // namespace talus::dem
