#include "fem_solver/output/part_fields.hpp"

#include <cmath>

namespace talus::fem {
namespace {

using At = const Configuration&;

/// A value that every cell of a batch has, or that the batch has as a whole.
template <class Batch>
struct CellQuantity {
  const char* name;
  const char* unit;
  double (*value)(const Batch&, At, Index cell);
};
template <class Batch>
struct PartQuantity {
  const char* name;
  double (*value)(const Batch&, At);
};

/// The largest of a cell value.
template <class Batch, class Value>
double largest(const Batch& batch, const Value& value) {
  double result = 0;
  for (Index e = 0; e < batch.size(); ++e) result = std::max(result, value(e));
  return result;
}

template <class Compression>
struct Quantities {
  using Batch = TwoNodeBatch<Compression>;
  static constexpr core::CellKind kind = core::CellKind::segment;
  static constexpr CellQuantity<Batch> cells[] = {
      {"axial_force", "N", [](const Batch& b, At u, Index e) { return b.axial_force(u, e); }},
      {"stress", "Pa", [](const Batch& b, At u, Index e) { return b.stress(u, e); }}};
  static constexpr PartQuantity<Batch> whole[] = {
      {"axial_force_max_N",
       [](const Batch& b, At u) { return largest(b, [&](Index e) { return b.axial_force(u, e); }); }}};
};

struct RopeQuantities {
  using Batch = SlidingCableBatch;
  static constexpr core::CellKind kind = core::CellKind::segment;
  static constexpr CellQuantity<Batch> cells[] = {
      {"axial_force", "N", [](const Batch& b, At u, Index) { return b.tension(u); }},
      {"stress", "Pa", [](const Batch& b, At u, Index) { return b.stress(u); }}};
  static constexpr PartQuantity<Batch> whole[] = {
      {"axial_force_max_N", [](const Batch& b, At u) { return b.tension(u); }},
      {"elongation_m", [](const Batch& b, At u) { return b.length(u) - b.line().reference_length(); }}};
};

struct FrictionalRopeQuantities {
  using Batch = FrictionalCableBatch;
  static constexpr core::CellKind kind = core::CellKind::segment;
  static constexpr CellQuantity<Batch> cells[] = {
      {"axial_force", "N", [](const Batch& b, At u, Index e) { return b.tension(u, e); }},
      {"stress", "Pa", [](const Batch& b, At u, Index e) { return b.stress(u, e); }},
      {"slip", "m", [](const Batch& b, At u, Index e) { return b.slip(u, e); }}};
  static constexpr PartQuantity<Batch> whole[] = {
      {"axial_force_max_N",
       [](const Batch& b, At u) {
         double result = 0;
         for (Index e = 0; e < b.line().segments(); ++e) result = std::max(result, b.tension(u, e));
         return result;
       }},
      {"elongation_m", [](const Batch& b, At u) { return b.length(u) - b.line().reference_length(); }},
      {"slip_max_m",
       [](const Batch& b, At u) {
         double result = 0;
         for (Index e = 0; e < b.line().segments(); ++e)
           if (std::abs(b.slip(u, e)) > std::abs(result)) result = b.slip(u, e);
         return result;
       }},
      {"friction_J", [](const Batch& b, At u) { return b.dissipated(u); }}};
};

/// Brakes and elastic-plastic ropes; what is kept is the travel (m) of the one, the plastic strain of the
/// other.
template <class Law>
struct PathQuantities {
  using Batch = PathBatch<Law>;
  static constexpr bool is_brake = std::is_same_v<Law, BrakeLaw>;
  static constexpr core::CellKind kind = core::CellKind::segment;
  static constexpr CellQuantity<Batch> cells[] = {
      {"axial_force", "N", [](const Batch& b, At u, Index e) { return b.axial_force(u, e); }},
      {"elongation", "m", [](const Batch& b, At u, Index e) { return b.elongation(u, e); }},
      {is_brake ? "brake_travel" : "plastic_strain", is_brake ? "m" : "1",
       [](const Batch& b, At u, Index e) { return b.kept(u, e); }}};
  static constexpr PartQuantity<Batch> whole[] = {
      {"axial_force_max_N",
       [](const Batch& b, At u) { return largest(b, [&](Index e) { return b.axial_force(u, e); }); }},
      {is_brake ? "travel_max_m" : "plastic_strain_max_1",
       [](const Batch& b, At u) { return largest(b, [&](Index e) { return b.kept(u, e); }); }},
      {"dissipated_J", [](const Batch& b, At u) { return b.dissipated(u); }}};
};

/// What breaks; besides, its own memory where it has one.
template <class Law>
struct BreakingQuantities {
  using Batch = PathBatch<Law>;
  static constexpr core::CellKind kind = core::CellKind::segment;
  static constexpr CellQuantity<Batch> cells[] = {
      {"axial_force", "N", [](const Batch& b, At u, Index e) { return b.axial_force(u, e); }},
      {"elongation", "m", [](const Batch& b, At u, Index e) { return b.elongation(u, e); }},
      {"broken", "1", [](const Batch& b, At u, Index e) { return b.is_broken(u, e) ? 1.0 : 0.0; }}};
  static constexpr PartQuantity<Batch> whole[] = {
      {"axial_force_max_N",
       [](const Batch& b, At u) { return largest(b, [&](Index e) { return b.axial_force(u, e); }); }},
      {"broken_1",
       [](const Batch& b, At u) {
         double count = 0;
         for (Index e = 0; e < b.size(); ++e) count += b.is_broken(u, e) ? 1 : 0;
         return count;
       }},
      {"dissipated_J", [](const Batch& b, At u) { return b.dissipated(u); }}};
};

template <class Rope>
struct BreakingRopeQuantities {
  using Batch = BreakingRope<Rope>;
  static constexpr core::CellKind kind = core::CellKind::segment;
  static constexpr CellQuantity<Batch> cells[] = {
      {"axial_force", "N", [](const Batch& b, At u, Index e) { return b.tension_of(u, e); }},
      {"broken", "1", [](const Batch& b, At u, Index) { return b.is_broken(u) ? 1.0 : 0.0; }}};
  static constexpr PartQuantity<Batch> whole[] = {
      {"axial_force_max_N", [](const Batch& b, At u) { return b.axial_force(u); }},
      {"elongation_m", [](const Batch& b, At u) { return b.elongation(u); }},
      {"broken_1", [](const Batch& b, At u) { return b.is_broken(u) ? 1.0 : 0.0; }},
      {"dissipated_J", [](const Batch& b, At u) { return b.dissipated(u); }}};
};

template <class Law>
struct RingQuantities {
  using Batch = RingBatch<Law>;
  static constexpr core::CellKind kind = core::CellKind::segment;
  static double broken(const Batch& b, At u, Index ring) {
    if constexpr (Breaks<Batch>)
      return b.is_broken(u, ring) ? 1 : 0;
    else
      return 0;
  }
  static constexpr CellQuantity<Batch> cells[] = {
      {"axial_force", "N", [](const Batch& b, At u, Index e) { return b.axial_force(u, b.element_of(e)); }},
      {"elongation", "m", [](const Batch& b, At u, Index e) { return b.elongation(u, b.element_of(e)); }},
      {"broken", "1", [](const Batch& b, At u, Index e) { return broken(b, u, b.element_of(e)); }}};
  static constexpr PartQuantity<Batch> whole[] = {
      {"axial_force_max_N",
       [](const Batch& b, At u) { return largest(b, [&](Index e) { return b.axial_force(u, e); }); }},
      {"elongation_max_m",
       [](const Batch& b, At u) { return largest(b, [&](Index e) { return b.elongation(u, e); }); }},
      {"broken_1",
       [](const Batch& b, At u) {
         double count = 0;
         for (Index e = 0; e < b.size(); ++e) count += broken(b, u, e);
         return count;
       }},
      {"dissipated_J", [](const Batch& b, At u) { return b.dissipated(u); }}};
};

struct ObstacleQuantities {
  using Batch = ObstacleBatch;
  static constexpr core::CellKind kind = core::CellKind::vertex;
  static constexpr CellQuantity<Batch> cells[] = {
      {"obstacle_force", "N", [](const Batch& b, At u, Index e) { return b.force(u, e); }},
      {"depth", "m", [](const Batch& b, At u, Index e) { return b.depth(u, e); }}};
  static constexpr PartQuantity<Batch> whole[] = {
      {"obstacle_force_max_N",
       [](const Batch& b, At u) { return largest(b, [&](Index e) { return b.force(u, e); }); }},
      {"obstacle_force_sum_N",
       [](const Batch& b, At u) {
         double sum = 0;
         for (Index e = 0; e < b.size(); ++e) sum += b.force(u, e);
         return sum;
       }},
      {"depth_max_m",
       [](const Batch& b, At u) { return largest(b, [&](Index e) { return b.depth(u, e); }); }},
      {"friction_J", [](const Batch& b, At u) { return b.dissipated(u); }}};
};

template <std::size_t nodes>
struct UserQuantities {
  using Batch = UserBatch<nodes>;
  static constexpr core::CellKind kind = nodes == 2 ? core::CellKind::segment : core::CellKind::triangle;
  static constexpr CellQuantity<Batch> cells[] = {
      {"energy", "J", [](const Batch& b, At u, Index e) { return b.energy(u, e); }}};
  static constexpr PartQuantity<Batch> whole[] = {
      {"energy_J", [](const Batch& b, At u) { return b.energy(u); }}};
};

double larger_principal(const PlaneStress<double>& s) {
  return 0.5 * (s.xx + s.yy) + std::hypot(0.5 * (s.xx - s.yy), s.xy);
}

template <class Law>
struct MembraneQuantities {
  using Batch = MembraneBatch<Law>;
  static constexpr core::CellKind kind = core::CellKind::triangle;
  static double area_in(const Batch& b, At u, SheetState state) {
    double sum = 0;
    for (Index e = 0; e < b.size(); ++e)
      if (b.state(u, e) == state) sum += b.triangle(e).volume / b.part().thickness;
    return sum;
  }
  static constexpr CellQuantity<Batch> cells[] = {
      {"stress_xx", "Pa", [](const Batch& b, At u, Index e) { return b.stress(u, e).xx; }},
      {"stress_yy", "Pa", [](const Batch& b, At u, Index e) { return b.stress(u, e).yy; }},
      {"stress_xy", "Pa", [](const Batch& b, At u, Index e) { return b.stress(u, e).xy; }},
      {"wrinkle_state", "1", [](const Batch& b, At u, Index e) { return double(b.state(u, e)); }}};
  static constexpr PartQuantity<Batch> whole[] = {
      {"stress_max_Pa",
       [](const Batch& b, At u) {
         return largest(b, [&](Index e) { return larger_principal(b.stress(u, e)); });
       }},
      {"wrinkled_area_m2", [](const Batch& b, At u) { return area_in(b, u, SheetState::wrinkled); }},
      {"slack_area_m2", [](const Batch& b, At u) { return area_in(b, u, SheetState::slack); }}};
};

struct SlideQuantities {
  using Batch = PenaltySlideBatch;
  static constexpr core::CellKind kind = core::CellKind::vertex;
  static constexpr CellQuantity<Batch> cells[] = {
      {"gap", "m", [](const Batch& b, At u, Index k) { return b.gap(u, std::size_t(k)); }},
      {"slide_force", "N", [](const Batch& b, At u, Index k) { return b.force(u, std::size_t(k)); }},
      {"place_on_rope", "m", [](const Batch& b, At u, Index k) { return b.place(u, std::size_t(k)); }}};
  template <class Value>
  static double largest_of(const Batch& b, const Value& value) {
    double result = 0;
    for (std::size_t k = 0; k < b.line().sliders.size(); ++k) result = std::max(result, value(k));
    return result;
  }
  static constexpr PartQuantity<Batch> whole[] = {
      {"gap_max_m",
       [](const Batch& b, At u) { return largest_of(b, [&](std::size_t k) { return b.gap(u, k); }); }},
      {"slide_force_max_N",
       [](const Batch& b, At u) { return largest_of(b, [&](std::size_t k) { return b.force(u, k); }); }}};
};

/// The quantities of a batch.
template <class Batch>
struct QuantitiesOf;
template <class Compression>
struct QuantitiesOf<TwoNodeBatch<Compression>> : Quantities<Compression> {};
template <>
struct QuantitiesOf<SlidingCableBatch> : RopeQuantities {};
template <>
struct QuantitiesOf<FrictionalCableBatch> : FrictionalRopeQuantities {};
template <class Rope>
struct QuantitiesOf<BreakingRope<Rope>> : BreakingRopeQuantities<Rope> {};
template <class Law>
struct QuantitiesOf<RingBatch<Law>> : RingQuantities<Law> {};
template <std::size_t nodes>
struct QuantitiesOf<UserBatch<nodes>> : UserQuantities<nodes> {};
template <>
struct QuantitiesOf<ObstacleBatch> : ObstacleQuantities {};
template <>
struct QuantitiesOf<PenaltySlideBatch> : SlideQuantities {};
template <class Law>
struct QuantitiesOf<PathBatch<Law>> : PathQuantities<Law> {};
template <class Law>
struct QuantitiesOf<PathBatch<Breaking<Law>>> : BreakingQuantities<Breaking<Law>> {};
template <class Law>
struct QuantitiesOf<MembraneBatch<Law>> : MembraneQuantities<Law> {};

}  // namespace

core::CellKind cell_kind(const ElementBatch& elements) {
  return std::visit([](const auto& batch) { return QuantitiesOf<std::decay_t<decltype(batch)>>::kind; },
                    elements);
}

std::vector<core::FieldDescription> element_fields(const ElementBatch& elements) {
  std::vector<core::FieldDescription> fields;
  std::visit(
      [&](const auto& batch) {
        for (const auto& quantity : QuantitiesOf<std::decay_t<decltype(batch)>>::cells)
          fields.push_back({.name = quantity.name,
                            .unit = quantity.unit,
                            .components = 1,
                            .location = core::FieldLocation::cell});
      },
      elements);
  return fields;
}

void fill_element_field(const ElementBatch& elements, std::size_t field, const Configuration& at,
                        std::span<double> values) {
  std::visit(
      [&](const auto& batch) {
        const auto& quantity = QuantitiesOf<std::decay_t<decltype(batch)>>::cells[field];
        for (std::size_t e = 0; e < values.size(); ++e)
          values[e] = quantity.value(batch, at, static_cast<Index>(e));
      },
      elements);
}

std::vector<const char*> part_quantities(const ElementBatch& elements) {
  std::vector<const char*> names;
  std::visit(
      [&](const auto& batch) {
        for (const auto& quantity : QuantitiesOf<std::decay_t<decltype(batch)>>::whole)
          names.push_back(quantity.name);
      },
      elements);
  return names;
}

double part_quantity(const ElementBatch& elements, std::size_t quantity, const Configuration& at) {
  return std::visit(
      [&](const auto& batch) {
        return QuantitiesOf<std::decay_t<decltype(batch)>>::whole[quantity].value(batch, at);
      },
      elements);
}

}  // namespace talus::fem
