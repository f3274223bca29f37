#pragma once
// Says for the length of a scope that something goes on; also when the scope is left by an
// exception, so that one request that broke does not keep out all others.

namespace axiscal {

class Held {
public:
    explicit Held(bool& flag)
        : flag_{flag} {
        flag_ = true;
    }
    ~Held() { flag_ = false; }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;

private:
    bool& flag_;
};

} // namespace axiscal
