#pragma once

namespace talus::study {

/// How many cores other programs keep busy: what the machine did, less what this process and its children did. Time
/// that a virtual machine was denied by its host counts as busy.
class OtherLoad {
 public:
  OtherLoad();  ///< looks at the machine for a tenth of a second

  /// Busy cores of others since the last call that had a tenth of a second to look at, which a run is in between;
  /// in a shorter time the value is that of the last call.
  double now();

 private:
  double machine_ = 0, own_ = 0,
         when_ = 0;  ///< s, at the last look: busy time, own processor time, wall time
  double load_ = 0;
};

}  // namespace talus::study
