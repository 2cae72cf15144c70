#include "fem_solver/model/membrane_batch.hpp"

#include <utility>

namespace talus::fem {
namespace {

/// Writes one lane of a pack's triangle; reading it back gives the same bits.
void put(MembraneTriangle<Lanes>& pack, std::size_t lane, const MembraneTriangle<double>& triangle) {
  for (std::size_t k = 0; k < 2; ++k) {
    pack.axes[k].x.set(lane, triangle.axes[k].x);
    pack.axes[k].y.set(lane, triangle.axes[k].y);
    pack.axes[k].z.set(lane, triangle.axes[k].z);
    for (std::size_t i = 0; i < 2; ++i) pack.gradient[i][k].set(lane, triangle.gradient[i][k]);
  }
  pack.volume.set(lane, triangle.volume);
}

MembraneTriangle<double> take(const MembraneTriangle<Lanes>& pack, std::size_t lane) noexcept {
  const auto triple = [lane](const Triple<Lanes>& v) {
    return Triple<double>{v.x[lane], v.y[lane], v.z[lane]};
  };
  const auto& g = pack.gradient;
  return {{triple(pack.axes[0]), triple(pack.axes[1])},
          {{{g[0][0][lane], g[0][1][lane]}, {g[1][0][lane], g[1][1][lane]}}},
          pack.volume[lane]};
}

using LaneNodes = std::array<Index, Lanes::size()>;

/// Differences of the displacements of two corners, for every lane.
Triple<Lanes> gather_difference(const double* u, const LaneNodes& from, const LaneNodes& to) noexcept {
  const auto component = [&](std::size_t c) {
    return Lanes([&](std::size_t lane) {
      return u[3 * static_cast<std::size_t>(to[lane]) + c] - u[3 * static_cast<std::size_t>(from[lane]) + c];
    });
  };
  return {component(0), component(1), component(2)};
}

}  // namespace

template <class Law>
MembraneBatch<Law>::MembraneBatch(const MembranePart& part, const Law& law,
                                  std::vector<std::array<Index, 3>> triangles,
                                  std::span<const double> reference)
    : part_(part), law_(law), triangles_(std::move(triangles)) {
  const std::size_t count = (triangles_.size() + Lanes::size() - 1) / Lanes::size();
  packs_.assign(count, MembraneTriangle<Lanes>{});
  nodes_.assign(count, {});
  for (std::size_t e = 0; e < triangles_.size(); ++e) {
    MembranePatch patch{{}, part.thickness, part.material_axis};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Index node = triangles_[e][corner];
      patch.nodes[corner] = Vector3::Map(&reference[3 * place(node)]);
      nodes_[e / Lanes::size()][corner][e % Lanes::size()] = node;
    }
    put(packs_[e / Lanes::size()], e % Lanes::size(), membrane_triangle(patch));
  }
}

template <class Law>
template <class FillPack>
void MembraneBatch<Law>::for_each_pack(core::Block elements, const FillPack& fill) noexcept {
  static_assert(core::default_block_length % lanes == 0, "blocks of elements begin with a pack");
  const auto end = static_cast<Index>((elements.end + lanes - 1) / lanes);
  for (auto pack = static_cast<Index>(elements.begin / lanes); pack < end; ++pack) fill(pack);
}

template <class Law>
template <class StressOf>
void MembraneBatch<Law>::fill_pack(const Configuration& at, std::span<double> slots, Index pack,
                                   const StressOf& stress_of) const noexcept {
  const auto& nodes = nodes_[place(pack)];
  const auto& [first, second, third] = nodes;
  const MembraneTriangle<Lanes>& triangle = packs_[place(pack)];
  const auto deformation = triangle.deform({gather_difference(at.displacement.data(), first, second),
                                            gather_difference(at.displacement.data(), first, third)});
  const auto force = triangle.force(deformation, stress_of(triangle, deformation, nodes));
  const Index filled = std::min(lanes, size() - pack * lanes);
  double* slot = &slots[6 * place(pack * lanes)];
  for (std::size_t lane = 0; lane < place(filled); ++lane)
    for (const Triple<Lanes>& f : force) {
      *slot++ = f.x[lane];
      *slot++ = f.y[lane];
      *slot++ = f.z[lane];
    }
}

template <class Law>
void MembraneBatch<Law>::internal_force(const Configuration& at, std::span<double> slots,
                                        core::Block elements) const noexcept {
  const auto stress_of = [&](const auto&, const auto& deformation, const auto&) {
    return law_.stress(deformation.strain);
  };
  for_each_pack(elements, [&](Index pack) { fill_pack(at, slots, pack, stress_of); });
}

template <class Law>
void MembraneBatch<Law>::damping_product(const Configuration& at, std::span<const double> velocity,
                                         std::span<double> slots, core::Block elements) const noexcept {
  const auto stress_of = [&](const auto& triangle, const auto& deformation, const auto& nodes) {
    const auto& [first, second, third] = nodes;
    return law_.rate_stress(
        deformation.strain,
        triangle.strain_rate(deformation, {gather_difference(velocity.data(), first, second),
                                           gather_difference(velocity.data(), first, third)}));
  };
  for_each_pack(elements, [&](Index pack) { fill_pack(at, slots, pack, stress_of); });
}

template <class Law>
MembraneTriangle<double> MembraneBatch<Law>::triangle(Index e) const noexcept {
  return take(packs_[place(e / lanes)], place(e % lanes));
}

template <class Law>
std::array<Triple<double>, 2> MembraneBatch<Law>::relative(std::span<const double> values,
                                                           Index e) const noexcept {
  const auto difference = [&](Index from, Index to) {
    const double *a = &values[3 * place(from)], *b = &values[3 * place(to)];
    return Triple<double>{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  };
  const auto [first, second, third] = triangles_[place(e)];
  return {difference(first, second), difference(first, third)};
}

template <class Law>
MembraneTriangle<double>::Deformation MembraneBatch<Law>::deformation(const Configuration& at,
                                                                      Index e) const noexcept {
  return triangle(e).deform(relative(at.displacement, e));
}

template <class Law>
void MembraneBatch<Law>::product(const Configuration& at, std::span<const double> direction,
                                 const PlaneMatrix& moduli, Index e, std::span<double> slots) const noexcept {
  const MembraneTriangle<double> shape = triangle(e);
  const auto state = shape.deform(relative(at.displacement, e));
  const auto changes = shape.force_change(state, law_.stress(state.strain), moduli, relative(direction, e));
  double* slot = &slots[6 * place(e)];
  for (const Triple<double>& f : changes) {
    *slot++ = f.x;
    *slot++ = f.y;
    *slot++ = f.z;
  }
}

template <class Law>
void MembraneBatch<Law>::stiffness_product(const Configuration& at, std::span<const double> direction,
                                           std::span<double> slots, core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e)
    product(at, direction, law_.tangent(deformation(at, e).strain), e, slots);
}

template <class Law>
void MembraneBatch<Law>::stiffest_product(const Configuration& at, std::span<const double> direction,
                                          std::span<double> slots, core::Block elements) const noexcept {
  for (auto e = static_cast<Index>(elements.begin); e < elements.end; ++e)
    product(at, direction, law_.stiffest_tangent(), e, slots);
}

template <class Law>
void MembraneBatch<Law>::add_stiffness_bound(const Configuration& at,
                                             std::span<double> row_sums) const noexcept {
  for (Index e = 0; e < size(); ++e) {
    const auto state = deformation(at, e);
    const Matrix9 K =
        membrane_stiffness(triangle(e), state, law_.stress(state.strain), law_.stiffest_tangent());
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        Vector3::Map(&row_sums[3 * place(triangles_[place(e)][static_cast<std::size_t>(i)])]) +=
            K.block<3, 3>(3 * i, 3 * j).cwiseAbs().rowwise().sum();
  }
}

template <class Law>
double MembraneBatch<Law>::energy(const Configuration& at) const noexcept {
  double sum = 0;
  for (Index e = 0; e < size(); ++e)
    sum += triangle(e).volume * law_.energy_density(deformation(at, e).strain);
  return sum;
}

template <class Law>
void MembraneBatch<Law>::add_mass(std::span<double> node_masses) const noexcept {
  for (Index e = 0; e < size(); ++e)
    for (const Index node : triangles_[place(e)])
      node_masses[place(node)] += membrane_node_mass(triangle(e).volume, part_.density);
}

template <class Law>
Matrix9 MembraneBatch<Law>::element_stiffness(const Configuration& at, Index e) const {
  const auto state = deformation(at, e);
  return membrane_stiffness(triangle(e), state, law_.stress(state.strain), law_.tangent(state.strain));
}

/// The law's answer to each unit rate, without the stress's own part.
template <class Law>
Matrix9 MembraneBatch<Law>::element_damping(const Configuration& at, Index e) const {
  const auto state = deformation(at, e);
  PlaneMatrix moduli;
  for (int k = 0; k < 3; ++k)
    moduli.col(k) = to_vector(law_.rate_stress(
        state.strain, PlaneStrain<double>{k == 0 ? 1.0 : 0, k == 1 ? 1.0 : 0, k == 2 ? 1.0 : 0}));
  return membrane_stiffness(triangle(e), state, {0, 0, 0}, moduli);
}

template <class Law>
SheetState MembraneBatch<Law>::state(const Configuration& at, Index e) const noexcept {
  return law_.state(deformation(at, e).strain);
}

template <class Law>
PlaneStress<double> MembraneBatch<Law>::stress(const Configuration& at, Index e) const noexcept {
  return law_.stress(deformation(at, e).strain);
}

template class MembraneBatch<LinearSheet>;
template class MembraneBatch<TensionField<ExactWrinkles>>;
template class MembraneBatch<TensionField<PrincipalWrinkles>>;

}  // namespace talus::fem
