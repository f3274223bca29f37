#include "acquisition/events/notify/http_post.hpp"

#include "config/version.hpp"

#include <curl/curl.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace axiscal {
namespace {

constexpr long connect_limit_s = 10, whole_limit_s = 20;
constexpr curl_off_t longest_retry_after_s = 86'400;      // whatever is written there
constexpr std::size_t most_read = std::size_t{64} * 1024; // of an answer; only its status counts

struct FreeList {
    void operator()(curl_slist* list) const { curl_slist_free_all(list); }
};
using Headers = std::unique_ptr<curl_slist, FreeList>;

void add_header(Headers& headers, const std::string& line) {
    curl_slist* const longer = curl_slist_append(headers.get(), line.c_str());
    if (longer == nullptr) return; // no memory: the receiver refuses what is not signed
    static_cast<void>(headers.release());
    headers.reset(longer);
}

Headers headers_of(const WebhookPost& post) {
    Headers headers;
    add_header(headers, "Content-Type: application/json");
    add_header(headers, "Expect:"); // a body this small waits for no leave
    add_header(headers, "webhook-id: " + post.id);
    add_header(headers, "webhook-timestamp: " + std::to_string(post.utc_s));
    add_header(headers, "webhook-signature: " + post.signatures);
    return headers;
}

/// Counts and forgets; an answer without end is cut off.
std::size_t pass_over(char*, std::size_t size, std::size_t count, void* read) {
    auto& so_far = *static_cast<std::size_t*>(read);
    so_far += size * count;
    return so_far > most_read ? 0 : size * count;
}

} // namespace

struct HttpPost::Handle {
    CURL* curl = nullptr;
    std::array<char, CURL_ERROR_SIZE> words{};
    std::size_t read = 0;
};

HttpPost::HttpPost(WebhookConfig config)
    : config_{std::move(config)}
    , handle_{std::make_unique<Handle>()} {
    curl_global_init(CURL_GLOBAL_DEFAULT);
    CURL* const curl = handle_->curl = curl_easy_init();
    if (curl == nullptr) return;
    curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR,
                     config_.place.starts_with("https") ? "https" : "http");
    curl_easy_setopt(curl, CURLOPT_URL, config_.url.c_str());
    curl_easy_setopt(curl, CURLOPT_USERAGENT,
                     (std::string{"axiscal/"} + software_version()).c_str());
    curl_easy_setopt(curl, CURLOPT_HTTP_VERSION, static_cast<long>(CURL_HTTP_VERSION_1_1));
    curl_easy_setopt(curl, CURLOPT_FOLLOWLOCATION, 0L);
    curl_easy_setopt(curl, CURLOPT_PROXY, ""); // none by the environment either
    curl_easy_setopt(curl, CURLOPT_NETRC, static_cast<long>(CURL_NETRC_IGNORED));
    curl_easy_setopt(curl, CURLOPT_SSL_VERIFYPEER, 1L);
    curl_easy_setopt(curl, CURLOPT_SSL_VERIFYHOST, 2L);
    curl_easy_setopt(curl, CURLOPT_SSLVERSION, static_cast<long>(CURL_SSLVERSION_TLSv1_2));
    if (!config_.ca_file.empty()) {
        curl_easy_setopt(curl, CURLOPT_CAINFO, config_.ca_file.c_str());
        curl_easy_setopt(curl, CURLOPT_CAPATH, nullptr); // these vouch, and no others
    }
    curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
    curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, connect_limit_s);
    curl_easy_setopt(curl, CURLOPT_TIMEOUT, whole_limit_s);
    curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, &pass_over);
    curl_easy_setopt(curl, CURLOPT_WRITEDATA, &handle_->read);
    curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, handle_->words.data());
}

HttpPost::~HttpPost() {
    curl_easy_cleanup(handle_->curl);
    curl_global_cleanup();
}

WebhookAnswer HttpPost::operator()(const WebhookPost& post) {
    CURL* const curl = handle_->curl;
    if (curl == nullptr) return {0, "libcurl has no memory", {}};
    handle_->words.front() = '\0';
    handle_->read = 0;
    const Headers headers = headers_of(post);
    curl_easy_setopt(curl, CURLOPT_HTTPHEADER, headers.get());
    curl_easy_setopt(curl, CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(post.body.size()));
    curl_easy_setopt(curl, CURLOPT_POSTFIELDS, post.body.c_str());
    const CURLcode done = curl_easy_perform(curl);
    curl_easy_setopt(curl, CURLOPT_HTTPHEADER, nullptr); // the list ends with this call
    long status = 0;
    curl_off_t retry_after_s = 0;
    curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &status);
    curl_easy_getinfo(curl, CURLINFO_RETRY_AFTER, &retry_after_s);
    // An answer that is cut off because it is long has told its status; one that broke has not told
    // that the receiver is done with the event.
    const bool told = done == CURLE_OK || (done == CURLE_WRITE_ERROR && handle_->read > most_read);
    if (!told) {
        const char* const words =
            handle_->words.front() != '\0' ? handle_->words.data() : curl_easy_strerror(done);
        return {0, config_.place + ": " + words, {}};
    }
    WebhookAnswer answer{static_cast<int>(status), "", {}};
    if (retry_after_s > 0)
        answer.retry_after = std::chrono::seconds{std::min(retry_after_s, longest_retry_after_s)};
    return answer;
}

} // namespace axiscal
