#pragma once

#include <atomic>
#include <memory>

namespace window_ingress::adapters {

/// Whether the ROS master still knows this node, asked once a second. A master that was restarted does not:
/// no service, no tool and no second launch then reaches the node, which works on. A master that does not
/// answer changes nothing. Only a thread of its own waits for the master.
class MasterWatch {
 public:
  /// Call when the node has registered its topics.
  MasterWatch();
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

  /// Whether the master has said twice in a row that it does not know this node at its address, but did
  /// before.
  bool isForgotten() const;

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;  // the thread may outlive this: a master that hangs never answers
};

}  // namespace window_ingress::adapters
