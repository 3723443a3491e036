//! Rows in registers of eight numbers, instruction by instruction: from loops over lanes the compiler makes three
//! times as many here.

use super::{Bytes, Registers, Run};
use crate::scanlines::frame::Cone;
use crate::scanlines::lines::{REPLICATES, Row};
use pulp::x86::V3;
use std::arch::x86_64::{__m256, __m256i, _CMP_LT_OQ, _CMP_NLT_UQ, _MM_FROUND_NO_EXC, _MM_FROUND_TO_POS_INF};

/// A byte in each of a number's.
const EACH: i32 = 0x0101_0101;

const UP: i32 = _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC;

impl Registers for V3 {
    #[inline(always)]
    fn before(self, run: &Run, row: &Row, layers: &mut [i32; REPLICATES]) {
        let weight = self.avx._mm256_set1_epi32(run.weight);
        let added = self.avx2._mm256_and_si256(crosses(self, run, row), weight);
        let sum = self.avx2._mm256_add_epi32(bytemuck::cast(*layers), added);
        *layers = bytemuck::cast(sum);
    }

    #[inline(always)]
    fn across<const WORDS: usize>(
        self,
        run: &Run,
        row: &Row,
        (cone, half): (Option<&Cone>, f32),
        words: &mut [Bytes; WORDS],
    ) {
        let (avx, avx2) = (self.avx, self.avx2);
        let all = |value: f32| avx._mm256_set1_ps(value);
        let y: __m256 = bytemuck::cast(row.y.0);
        let mut x = avx._mm256_add_ps(avx._mm256_mul_ps(all(run.slope), y), all(run.at));
        if let Some(cone) = cone {
            x = along(self, cone, x, bytemuck::cast(row.cos.0));
        }
        // As `Eight::number`.
        let half = all(half);
        let centre = avx._mm256_sub_ps(half, bytemuck::cast(row.shift.0));
        let place = avx._mm256_add_ps(avx._mm256_mul_ps(x, half), centre);
        let place = avx._mm256_min_ps(avx._mm256_max_ps(place, all(0.0)), all(32.0));
        let number = avx._mm256_cvtps_epi32(avx._mm256_round_ps::<UP>(place));
        let bits = avx2._mm256_slli_epi32::<3>(number);
        let weight = avx._mm256_set1_epi32(i32::from(run.weight as u8).wrapping_mul(EACH));
        let weight = avx2._mm256_and_si256(crosses(self, run, row), weight);
        let low = avx2._mm256_unpacklo_epi32(weight, weight);
        let high = avx2._mm256_unpackhi_epi32(weight, weight);
        let zero = avx._mm256_setzero_si256();
        for (w, word) in words.iter_mut().enumerate() {
            let start = avx._mm256_set1_epi32((64 * w) as i32);
            let bits = avx2._mm256_max_epi32(avx2._mm256_sub_epi32(bits, start), zero);
            // A shift by 64 or more leaves nothing.
            let low = avx2._mm256_sllv_epi64(low, avx2._mm256_unpacklo_epi32(bits, zero));
            let high = avx2._mm256_sllv_epi64(high, avx2._mm256_unpackhi_epi32(bits, zero));
            let [a, b]: [__m256i; 2] = bytemuck::cast(word.0);
            word.0 = bytemuck::cast([avx2._mm256_add_epi8(a, low), avx2._mm256_add_epi8(b, high)]);
        }
    }

    #[inline(always)]
    fn none(self, bytes: &Bytes, layers: &[i32; REPLICATES]) -> [u8; REPLICATES] {
        let (avx, avx2) = (self.avx, self.avx2);
        let all = |value: i32| avx._mm256_set1_epi32(value);
        let layers: __m256i = bytemuck::cast(*layers);
        // What a byte holds is above -128 and below 128; -128 stands for what no byte can make up for.
        let fits = avx2._mm256_cmpgt_epi32(all(128), avx2._mm256_abs_epi32(layers));
        let wanted = avx2._mm256_sub_epi32(avx._mm256_setzero_si256(), layers);
        let wanted = avx2._mm256_and_si256(avx2._mm256_blendv_epi8(all(0x80), wanted, fits), all(0xff));
        let wanted = avx2._mm256_mullo_epi32(wanted, all(EACH));
        let [a, b]: [__m256i; 2] = bytemuck::cast(bytes.0);
        let a = avx2._mm256_cmpeq_epi8(a, avx2._mm256_unpacklo_epi32(wanted, wanted));
        let b = avx2._mm256_cmpeq_epi8(b, avx2._mm256_unpackhi_epi32(wanted, wanted));
        bytemuck::cast([avx2._mm256_movemask_epi8(a), avx2._mm256_movemask_epi8(b)])
    }
}

/// Which replicates of a row an edge crosses.
#[inline(always)]
fn crosses(simd: V3, run: &Run, row: &Row) -> __m256i {
    let avx = simd.avx;
    let y: __m256 = bytemuck::cast(row.y.0);
    let over = avx._mm256_cmp_ps::<_CMP_NLT_UQ>(y, avx._mm256_set1_ps(run.low));
    let under = avx._mm256_cmp_ps::<_CMP_LT_OQ>(y, avx._mm256_set1_ps(run.high));
    avx._mm256_castps_si256(avx._mm256_and_ps(over, under))
}

/// As `Cone::along`.
#[inline(always)]
fn along(simd: V3, cone: &Cone, x: __m256, cos: __m256) -> __m256 {
    let avx = simd.avx;
    let all = |value: f32| avx._mm256_set1_ps(value);
    let w = avx._mm256_mul_ps(avx._mm256_mul_ps(x, all(cone.tan)), cos);
    let square = avx._mm256_mul_ps(w, w);
    if cone.narrow {
        let square = avx._mm256_min_ps(square, all(0.02));
        let next = avx._mm256_sub_ps(all(0.5), avx._mm256_mul_ps(square, all(0.375)));
        let root = avx._mm256_sub_ps(all(1.0), avx._mm256_mul_ps(square, next));
        avx._mm256_mul_ps(avx._mm256_mul_ps(w, root), all(cone.per_sin))
    } else {
        let root = avx._mm256_sqrt_ps(avx._mm256_add_ps(all(1.0), square));
        avx._mm256_div_ps(avx._mm256_mul_ps(w, all(cone.per_sin)), root)
    }
}
