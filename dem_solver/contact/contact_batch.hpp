#pragma once

#include <span>
#include <vector>

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

  [[no_unique_address]] ContactMemory<Law> memory_;

 private:
  std::vector<ContactWork> task_work_;  ///< empty without a ledger
};

}  // namespace talus::dem
