#pragma once

#include "dem_solver/contact/boundary_contacts.hpp"
#include "dem_solver/contact/pair_contacts.hpp"
#include "dem_solver/contact/plane_contacts.hpp"

namespace talus::dem {

/// What contacts work on, and the lists of who may touch whom.
struct ContactStage {
  Spheres& spheres;
  const Rocks& rocks;
  std::span<const Index> place;  ///< where each sphere's id stands
  std::span<const Plane> planes;
  Boundary& boundary;
  PairList& pair_list;
  PlaneList& plane_list;
  BoundaryList& boundary_list;
  const PairTable& table;
  ContactRule contact_rule = ContactRule::local_minima;
  const ImplicitContact* implicit_contact = nullptr;  ///< of the boundary; nullptr: explicit
  double step = 0;                                    ///< s; since the last evaluation
  int threads = 1;
};

/// Where the memory of contacts goes when the lists are rebuilt.
struct ContactMoves {
  std::span<const SlotMove> pairs, planes, boundary;
};

/// Everything of one composed law. The members stand in contact_model_stages.hpp and are compiled once a law,
/// in scene/.
template <class ComposedLaw>
class ContactModel {
 public:
  using Law = ComposedLaw;

  ContactModel();
  ContactModel(const ContactModel& other);
  ContactModel(ContactModel&& other) noexcept;
  ContactModel& operator=(const ContactModel& other);
  ContactModel& operator=(ContactModel&& other) noexcept;
  ~ContactModel();

  void rebuild(const ContactStage& stage, const ContactMoves& moves);
  // Each of these adds the loads of some contacts to the spheres. The lists must be up to date, of blocks see
  // PairList.
  void between_spheres(const ContactStage& stage, Index block) noexcept;
  void between_distant_spheres(const ContactStage& stage) noexcept;  ///< of the wide pairs
  void with_planes(const ContactStage& stage, Index block) noexcept;
  /// The last one, since implicit contact starts from the velocities that all other loads lead to; it sets the
  /// boundary's reactions, too.
  /// @return the sweeps that implicit contact needed; 0 where it is explicit
  int with_boundary(const ContactStage& stage) noexcept;

  /// J; since the last evaluation. Zero without a ledger.
  ContactWork last_work() const noexcept;
  /// J; in the springs at the last evaluation. Zero without a ledger.
  double stored_energy() const noexcept;

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    const auto as = [&](const char* name) {
      return [&visit, name](const char*, auto& array) { visit(name, array); };
    };
    ContactBatch<Law>::visit_state(self.pairs_, as("pair_memory"));
    ContactBatch<Law>::visit_state(self.planes_, as("plane_memory"));
    ContactBatch<Law>::visit_state(self.boundary_, as("boundary_memory"));
  }

 private:
  PairContacts<Law> pairs_;
  PlaneContacts<Law> planes_;
  BoundaryContacts<Law> boundary_;
};

}  // namespace talus::dem
