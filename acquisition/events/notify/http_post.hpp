#pragma once
// One POST by libcurl: TLS verified, no redirect followed, no cookie, no proxy, no account; bounded
// in time and in what is read of the answer. Blocks.

#include "acquisition/events/delivery.hpp"
#include "config/station_config.hpp"

#include <memory>

namespace axiscal {

class HttpPost {
public:
    explicit HttpPost(WebhookConfig config);
    ~HttpPost();
    HttpPost(const HttpPost&) = delete;
    HttpPost& operator=(const HttpPost&) = delete;

    /// At most 20 s. The words of a failure name server and port, never the path.
    WebhookAnswer operator()(const WebhookPost& post);

private:
    struct Handle;
    WebhookConfig config_;
    std::unique_ptr<Handle> handle_;
};

} // namespace axiscal
