"""The page where the station names a certificate: a browser that comes by https is paired, and its orders are taken."""

import subprocess

from page_bench import arm, before_arming, bench, expect, opened, pair_with, sentence, with_page


def with_certificate(b):
    """As docs/install.md has it made. Gives back the page's address."""
    address = with_page(b)
    certificate, key = b.folder / "fullchain.pem", b.folder / "key.pem"
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-noenc", "-days", "30", "-subj", "/CN=localhost",
                    "-addext", "subjectAltName=DNS:localhost,IP:127.0.0.1", "-keyout", key, "-out", certificate], check=True, capture_output=True, timeout=60)
    b.station["console"].update(certificate=str(certificate), key=str(key))
    return address.replace("http://", "https://")


@sentence("ByTlsABrowserIsPairedAndItsRunComesToTheCertificate")
def paired_by_tls(b):
    address = before_arming(b, with_certificate(b))
    with opened(address, trusts_everybody=True) as page:
        pair_with(b, page, "tablet")
        [cookie] = page.driver.get_cookies()
        expect(cookie["secure"] and cookie["httpOnly"] and cookie["sameSite"] == "Strict", f"{cookie}")
        arm(page, b.plan["datum_mm"])
        page.wait_for_text("#run_so_far", "20 of 20", 90)
        page.wait_for_text("#run_so_far", "certificate", 60)
        expect(b.run()["state"] == "complete", f"{b.run()}")


if __name__ == "__main__":
    bench.main()
