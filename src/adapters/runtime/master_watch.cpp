#include "adapters/runtime/master_watch.hpp"

#include <ros/master.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpc.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace window_ingress::adapters {

struct MasterWatch::Shared {
  const std::string host = ros::master::getHost(), name = ros::this_node::getName(),
                    own_uri = ros::XMLRPCManager::instance()->getServerURI();
  const int port = static_cast<int>(ros::master::getPort());
  std::atomic<bool> is_forgotten{false};
  std::mutex mutex;
  std::condition_variable changed;
  bool is_over = false, has_ended = false;  // under `mutex`
};

namespace {

enum class Answer { kNone, kKnown, kUnknown };

// A client of its own: those of roscpp may be gone when this thread still waits.
Answer ask(const std::string& host, int port, const std::string& name, const std::string& own_uri) {
  XmlRpc::XmlRpcClient master(host.c_str(), port, "/");
  XmlRpc::XmlRpcValue arguments, answer;
  arguments[0] = name;
  arguments[1] = name;
  const bool is_whole = master.execute("lookupNode", arguments, answer) && !master.isFault() &&
                        answer.getType() == XmlRpc::XmlRpcValue::TypeArray && answer.size() == 3 &&
                        answer[0].getType() == XmlRpc::XmlRpcValue::TypeInt;
  if (!is_whole) return Answer::kNone;
  const int code = answer[0];
  if (code == -1) return Answer::kUnknown;
  if (code != 1 || answer[2].getType() != XmlRpc::XmlRpcValue::TypeString) return Answer::kNone;
  return static_cast<std::string>(answer[2]) == own_uri ? Answer::kKnown : Answer::kUnknown;
}

}  // namespace

MasterWatch::MasterWatch() : shared_(std::make_shared<Shared>()) {
  std::thread([shared = shared_] {
    bool was_known = false;
    int times_unknown = 0;
    for (;;) {
      Answer answer = Answer::kNone;
      try {
        answer = ask(shared->host, shared->port, shared->name, shared->own_uri);
      } catch (const XmlRpc::XmlRpcException&) {
        answer = Answer::kNone;  // no answer that a master gives
      }
      was_known = was_known || answer == Answer::kKnown;
      if (answer != Answer::kNone) times_unknown = answer == Answer::kUnknown ? times_unknown + 1 : 0;
      shared->is_forgotten = was_known && times_unknown >= 2;
      std::unique_lock<std::mutex> lock(shared->mutex);
      if (shared->changed.wait_for(lock, std::chrono::seconds(1), [&] { return shared->is_over; })) {
        shared->has_ended = true;
        shared->changed.notify_all();
        return;
      }
    }
  }).detach();
}

MasterWatch::~MasterWatch() {
  constexpr std::chrono::milliseconds kPatience(300);  // for a master that answers
  std::unique_lock<std::mutex> lock(shared_->mutex);
  shared_->is_over = true;
  shared_->changed.notify_all();
  shared_->changed.wait_for(lock, kPatience, [this] { return shared_->has_ended; });
}

bool MasterWatch::isForgotten() const { return shared_->is_forgotten; }

}  // namespace window_ingress::adapters
