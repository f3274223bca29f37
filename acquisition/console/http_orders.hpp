#pragma once
// Orders that a person gives over HTTP: the body becomes an order of the station, its outcome the
// answer. Loop-bound; the station lives longer than the answer takes.

#include "acquisition/console/http_answer.hpp"
#include "acquisition/live/station_interface.hpp"

namespace axiscal {

// `by` is who asks, as the door knows him; the name comes from the body.

/// POST /v1/run. @param descriptor  of the connection: its end drops the order
Task<HttpResponse>
arm_by_request(StationInterface& station, HttpRequest request, Orderer by, int descriptor);
/// POST /v1/run/retake, and /v1/run/exclude with any other path.
Task<HttpResponse> revise_by_request(StationInterface& station, HttpRequest request, Orderer by);
/// POST /v1/run/answer.
Task<HttpResponse> answer_by_request(StationInterface& station, HttpRequest request, Orderer by);

} // namespace axiscal
