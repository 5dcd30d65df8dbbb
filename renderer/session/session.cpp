#include "renderer/session/session.h"

#include <utility>

#include "renderer/session/lab_worker.h"
#include "renderer/session/mailbox.h"

namespace quartet {

Session::Session(std::function<void()> notify) : mailbox_(std::make_unique<Mailbox>()) {
  thread_ = std::thread([mailbox = mailbox_.get(), notify = std::move(notify)]() mutable {
    LabWorker(*mailbox, std::move(notify)).run();
  });
}

Session::~Session() {
  close();
  thread_.join();
}

void Session::close() {
  mailbox_->close();
}

std::uint64_t Session::submit(LabRequest request) {
  return mailbox_->submit(std::move(request));
}

std::shared_ptr<const Snapshot> Session::latest() const {
  return mailbox_->latest();
}

SessionStatus Session::status() const {
  const std::shared_ptr<const SessionStatus> status = mailbox_->status();
  return status ? *status : SessionStatus();
}

bool Session::busy() const {
  return mailbox_->busy();
}

}  // namespace quartet
