# Runs in the root that minimal_root.sh makes.
set -eu
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
fail() { echo "FAILED: $*"; exit 1; }
station=/etc/axiscal/station.toml runs=/var/lib/axiscal/runs

apt-get -q update
apt-get -q install -y --no-install-recommends /packages/*.deb || fail "apt"
for tool in g++ cmake python3; do
    ! command -v $tool >/dev/null || fail "$tool is here: this root proves nothing"
done
echo "ok installed without what building needs"

for program in axiscald axiscal axiscal-notify axiscal-publish axiscal-report axiscal-simulate; do
    $program --version >/dev/null || fail "$program does not start"
done
axiscal conformance --brief >/dev/null || fail "the installed cases"
axiscal-simulate truth --scenario /usr/share/axiscal-simulate/scenarios/demo.toml --targets 10,250 --approaches 1 >/dev/null || fail "the simulated truth"
axiscal export /packages/fifty_points.axiscal --out /tmp >/dev/null || fail "the certificate"
[ "$(head -c 5 /tmp/*/certificate.pdf)" = %PDF- ] || fail "no certificate.pdf"
echo "ok every program runs"

[ "$(stat -c '%a %U %G' $station)" = "640 root axiscal" ] || fail "$station: $(stat -c '%a %U %G' $station)"
axiscal check-config $station >/dev/null || fail "the station file made of the example"
[ "$(stat -c '%a %U %G' $runs)" = "750 axiscal axiscal" ] || fail "$runs: $(stat -c '%a %U %G' $runs)"
[ ! -e /etc/systemd/system/multi-user.target.wants/axiscald.service ] || fail "the service is enabled before its station file is right"
echo "ok user, folders and station file are made"

echo "# a line of the person's own" >>$station
apt-get -q install -y --reinstall --no-install-recommends /packages/*.deb >/dev/null
grep -q "of the person's own" $station || fail "an update changed the station file"
echo "ok an update leaves the station file alone"

cp /packages/fifty_points.axiscal $runs/a.axiscal
chown axiscal: $runs/a.axiscal
echo secret >/var/lib/axiscal/token
echo hash >/var/lib/axiscal/paired-browsers
apt-get -q purge -y axiscal axiscal-publish axiscal-simulate axiscal-doc >/tmp/purge 2>&1 || { cat /tmp/purge; fail "purge"; }
cmp /packages/fifty_points.axiscal $runs/a.axiscal || fail "the run is gone"
[ "$(stat -c %U $runs/a.axiscal)" = axiscal ] || fail "the run belongs to nobody"
grep -q "$runs is kept" /tmp/purge || { cat /tmp/purge; fail "it is not said where the runs are"; }
echo "ok a purge keeps the runs and says where"

for gone in /etc/axiscal /var/lib/axiscal/token /var/lib/axiscal/paired-browsers /var/lib/axiscal/outbox /usr/bin/axiscal /usr/share/axiscal /lib/systemd/system/axiscald.service; do
    [ ! -e $gone ] || fail "$gone is still there after a purge: $(ls -la $gone)"
done
echo "ok a purge leaves nothing else"
