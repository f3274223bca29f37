#pragma once
// The pages of the certificate of a circular test, in the order in which they are bound.

#include "acquisition/documents/pdf/sheet.hpp"
#include "analysis/circular/circular_certificate.hpp"

#include <vector>

namespace axiscal {

/// Page 1: who, what, with what; both senses in one plot with the figures beside it, the largest
/// causes, the signatures.
/// @returns stated fields that did not fit and must be printed in full by the condition pages.
std::vector<StatedField> draw_circular_front_page(Sheet& sheet,
                                                  const CircularCertificate& certificate);

/// Each sense by itself: plot, ring and centres in numbers, control points.
void draw_circular_plot_pages(Sheet& sheet, const CircularCertificate& certificate);

/// What the form comes from: by weight, with signs in words and what to do; every cause of the fit;
/// each reversal.
void draw_circular_diagnosis(Sheet& sheet, const CircularCertificate& certificate);

/// Conditions that ISO 230-4 wants told, compensation, circles driven, uncertainty, remarks,
/// events.
void draw_circular_condition_pages(Sheet& sheet,
                                   const CircularCertificate& certificate,
                                   const std::vector<StatedField>& shortened);

/// What averaging and filter do to G, or that there was none; nothing of a case.
void draw_capture_effect(Sheet& sheet, const CircularCertificate& certificate);

/// Budget: what is stated, each term, each figure by formula and by trials.
void draw_circular_uncertainty(Sheet& sheet, const CircularCertificate& certificate);

/// Keys to the left and values to the right of a column; a value that does not fit beside its key
/// follows below. @returns the height
double draw_pairs(Canvas& canvas, PageBox column, const std::vector<StatedField>& pairs);

/// The control points of one zone by number: sense, side, angle, radius. @returns the height
double draw_control_points(Canvas& canvas,
                           PageBox column,
                           const CircularCertificate& certificate,
                           const CircularDeviation& deviation);

} // namespace axiscal
