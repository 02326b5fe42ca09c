// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <atomic>
#include <memory>

#include "base/text.h"
#include "gable/studio.h"
#include "studio/router.h"

namespace gable {

struct StudioDesk::Impl {
  explicit Impl(const StudioSettings& settings) : router(settings) {}
  studio::Router router;
};

StudioDesk::StudioDesk(const StudioSettings& settings) : impl_(std::make_unique<Impl>(settings)) {}
StudioDesk::~StudioDesk() = default;

bool StudioDesk::ok() const { return impl_->router.ok(); }

StudioAnswer StudioDesk::answer(StudioRequest request) {
  studio::HttpRequest asked;
  asked.method = std::move(request.method);
  asked.path = std::move(request.path);
  asked.query = std::move(request.query);
  asked.body = std::move(request.body);
  asked.cancelled = std::make_shared<std::atomic<bool>>(false);
  studio::HttpResponse told = studio::answered(
      [this](const studio::HttpRequest& r) { return impl_->router.answer(r); }, asked);
  told.body += joined(told.rest);
  return {told.status, std::move(told.type), std::move(told.body), std::move(told.headers)};
}

}  // namespace gable
