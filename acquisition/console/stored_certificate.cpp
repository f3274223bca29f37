#include "acquisition/console/stored_certificate.hpp"

namespace axiscal {
namespace {

std::string how_to_make(const StoredRun& run) {
    return "In the station's folder runs, 'axiscal export " + run.id +
           std::string{run_file_ending} +
           " --out FOLDER' makes the papers again from the run file.";
}

/// Figures of another evaluation are not those of the run as it stands.
Result<void> check_belongs(const CertificateFacts& facts, const RunSummary& summary) {
    if (facts.run_id != summary.run_id)
        return fail(Fault::refused, "it is the one of run " + facts.run_id);
    const auto stored = read_stored_result(summary.path);
    if (!stored && stored.error().fault == Fault::not_found) return {};
    if (!stored) return fail(Fault::refused, "the result that the run file keeps cannot be read");
    if (stored->digest == facts.result_digest) return {};
    return fail(Fault::refused, "its figures are not those that the run file keeps");
}

Result<CertificateFacts>
facts_in(const std::string& folder, const RunSummary& summary, std::size_t most) {
    AXISCAL_TRY(const std::string text, read_whole(folder + "/certificate.json", most));
    AXISCAL_TRY(CertificateFacts facts, facts_of_certificate(text));
    AXISCAL_CHECK(check_belongs(facts, summary));
    return facts;
}

} // namespace

std::string why_no_paper(const StoredRun& run) {
    switch (run.status) {
    case StoredStatus::open: return "A run gets its certificate when it is closed.";
    case StoredStatus::incomplete:
        return "The run is incomplete: it has no certificate and no verdict.";
    case StoredStatus::unreadable: return "What cannot be read gets no certificate.";
    case StoredStatus::complete: break;
    }
    if (!run.summary->evaluated) return "Its certificate is not made yet. " + how_to_make(run);
    return "No certificate of its last closing lies on this PC: it is being made, or was taken "
           "away. " +
           how_to_make(run);
}

void take_certificate(StoredRun& run, const std::vector<PaperFolder>& folders, std::size_t most) {
    run.paper_sentence = why_no_paper(run);
    for (const PaperFolder& place : folders) {
        auto facts = facts_in(place.path, *run.summary, most);
        if (!facts) {
            run.paper_sentence =
                "The certificate on this PC is not shown: " + facts.error().detail + ". " +
                how_to_make(run);
            continue;
        }
        run.facts = *std::move(facts);
        run.folder = place.path;
        run.paper = place.published ? PaperState::published : PaperState::waiting;
        run.paper_sentence.clear();
        return;
    }
}

std::string_view name_of(StoredStatus status) {
    switch (status) {
    case StoredStatus::open: return "open";
    case StoredStatus::complete: return "complete";
    case StoredStatus::incomplete: return "incomplete";
    case StoredStatus::unreadable: return "unreadable";
    }
    return "?";
}

std::string_view name_of(PaperState state) {
    switch (state) {
    case PaperState::none: return "none";
    case PaperState::waiting: return "waiting";
    case PaperState::published: return "published";
    }
    return "?";
}

} // namespace axiscal
