#pragma once
// A certificate and its key, made for one test: signed by itself, for "localhost".

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <memory>
#include <string>

namespace axiscal::test {

struct MadeCertificate {
    std::string certificate, key; ///< PEM
};

struct CertificateWanted {
    long begins_s = -3600, ends_s = 30L * 24 * 3600; ///< from now
    bool names_computer = true;
    const char* pass_phrase = nullptr;
};

template <class Write> std::string pem_of(Write write) {
    const std::unique_ptr<BIO, decltype(&BIO_free)> memory{BIO_new(BIO_s_mem()), &BIO_free};
    EXPECT_EQ(write(memory.get()), 1);
    char* bytes = nullptr;
    const long size = BIO_get_mem_data(memory.get(), &bytes);
    return {bytes, static_cast<std::size_t>(size)};
}

inline void add_names(X509* made) {
    X509V3_CTX place{};
    X509V3_set_ctx(&place, made, made, nullptr, nullptr, 0);
    const std::unique_ptr<X509_EXTENSION, decltype(&X509_EXTENSION_free)> names{
        X509V3_EXT_conf_nid(nullptr, &place, NID_subject_alt_name, "DNS:localhost,IP:127.0.0.1"),
        &X509_EXTENSION_free};
    ASSERT_EQ(X509_add_ext(made, names.get(), -1), 1);
}

inline MadeCertificate make_certificate(const CertificateWanted& wanted = {}) {
    const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key{EVP_EC_gen("P-256"),
                                                                  &EVP_PKEY_free};
    const std::unique_ptr<X509, decltype(&X509_free)> made{X509_new(), &X509_free};
    X509_set_version(made.get(), X509_VERSION_3);
    ASN1_INTEGER_set(X509_get_serialNumber(made.get()), 1);
    X509_gmtime_adj(X509_getm_notBefore(made.get()), wanted.begins_s);
    X509_gmtime_adj(X509_getm_notAfter(made.get()), wanted.ends_s);
    X509_set_pubkey(made.get(), key.get());
    X509_NAME* const name = X509_get_subject_name(made.get());
    X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC,
                               reinterpret_cast<const unsigned char*>("localhost"), -1, -1, 0);
    X509_set_issuer_name(made.get(), name);
    if (wanted.names_computer) add_names(made.get());
    EXPECT_GT(X509_sign(made.get(), key.get(), EVP_sha256()), 0);
    const EVP_CIPHER* const cipher = wanted.pass_phrase ? EVP_aes_256_cbc() : nullptr;
    return {pem_of([&](BIO* out) { return PEM_write_bio_X509(out, made.get()); }),
            pem_of([&](BIO* out) {
                return PEM_write_bio_PKCS8PrivateKey(out, key.get(), cipher, nullptr, 0, nullptr,
                                                     const_cast<char*>(wanted.pass_phrase));
            })};
}

/// With the rights that a key should have.
inline std::string write_secret(const std::filesystem::path& folder,
                                const std::string& name,
                                const std::string& text) {
    const std::string path = folder / name;
    std::FILE* const file = std::fopen(path.c_str(), "we");
    EXPECT_NE(file, nullptr) << path;
    if (file == nullptr) return path;
    EXPECT_EQ(std::fwrite(text.data(), 1, text.size(), file), text.size());
    std::fclose(file);
    std::filesystem::permissions(path, std::filesystem::perms::owner_read |
                                           std::filesystem::perms::owner_write);
    return path;
}

} // namespace axiscal::test
