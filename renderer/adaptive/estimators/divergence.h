#pragma once

namespace quartet {

/// Rigau, Feixas and Sbert, "Refinement Criteria Based on f-Divergences", EGSR 2003: with
/// p_i = L_i / ΣL and q_i = 1/n, the error is (1/n) · L̄ · √D. With x_i = L_i / L̄ = n p_i:
///   Kullback-Leibler  D = Σ p_i ln(p_i/q_i)   = (1/n) Σ x_i ln x_i
///   chi-square        D = Σ (p_i − q_i)²/q_i  = (1/n) Σ (x_i − 1)²
///   Hellinger         D = ½ Σ (√p_i − √q_i)²  = (1/2n) Σ (√x_i − 1)²
/// A window without light has error 0.
enum class Divergence { kl, chi2, hellinger };

}  // namespace quartet
