#pragma once

#include <span>
#include <vector>

#include "dem_solver/contact/law.hpp"
#include "dem_solver/contact/memory.hpp"
#include "dem_solver/contact/work.hpp"

namespace talus::dem {

/// What the contacts of one list have in common, whatever the partner is: their memory, and the work they did
/// at the last evaluation, counted by tasks so that its sum does not depend on the number of threads.
template <class Law>
class ContactBatch {
 public:
  using Memory = typename Law::StoredMemory;

  /// J; since the last evaluation.
  ContactWork last_work() const noexcept requires Law::has_ledger {
    ContactWork sum;
    for (const ContactWork& work : task_work_) sum += work;
    return sum;
  }
  /// J; in the springs at the last evaluation.
  double stored_energy() const noexcept requires Law::has_ledger {
    double sum = 0;
    for (const Memory& memory : memory_.all()) sum += Law::stored_energy(memory);
    return sum;
  }

  template <class Visitor>
  static void visit_state(ContactBatch& self, Visitor&& visit) {
    ContactMemory<Law>::visit_state(self.memory_, visit);
  }
  template <class Visitor>
  static void visit_state(const ContactBatch& self, Visitor&& visit) {
    ContactMemory<Law>::visit_state(self.memory_, visit);
  }

 protected:
  void rebuild(Index slots, std::span<const SlotMove> moves, Index tasks) {
    memory_.rebuild(slots, moves);
    if constexpr (Law::has_ledger) task_work_.assign(static_cast<std::size_t>(tasks), {});
  }
  /// J; of one of the tasks, since the last evaluation.
  void set_work(Index task, const ContactWork& work) noexcept {
    if constexpr (Law::has_ledger) task_work_[task] = work;
  }

  /// The loads of four contacts, of which the first `active` remember and do work.
  /// @param slot slot(k): where the k-th contact keeps its memory
  template <class Slot>
  TALUS_INLINE ContactLoad<Lanes> loads_of_four(const Touch<Lanes>& touch,
                                                const ContactParameters<Lanes>& parameters, double step,
                                                const Slot& slot, int active, ContactWork& work) noexcept {
    auto memory = memory_.lanes(slot);
    ContactLoss<Lanes> loss;
    const ContactLoad<Lanes> load = Law::evaluate(touch, parameters, step, memory, loss);
    memory_.store_lanes(slot, active, memory);
    if constexpr (Law::has_ledger)
      for (int k = 0; k < active; ++k) work += {.damping = loss.damping[k], .friction = loss.friction[k]};
    return load;
  }

  [[no_unique_address]] ContactMemory<Law> memory_;

 private:
  std::vector<ContactWork> task_work_;  ///< empty without a ledger
};

}  // namespace talus::dem
