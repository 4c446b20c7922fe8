//! k-means. (placeholder until the branch `rays` lands)

/// How to cluster.
#[derive(Debug, Clone, Copy)]
pub struct KMeansSpec {
    pub k: usize,
    pub seed: u64,
    pub restarts: usize,
    pub max_iterations: usize,
}

/// Clusters.
#[derive(Debug, Clone)]
pub struct KMeans {
    pub centroids: Vec<f32>,
    pub labels: Vec<u32>,
    pub inertia: f64,
}

pub fn k_means(points: &[f32], dimensions: usize, spec: KMeansSpec) -> KMeans {
    let count = points.len() / dimensions;
    let mut best: Option<KMeans> = None;
    let mut state = spec.seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut random = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let at = |index: usize| &points[index * dimensions..(index + 1) * dimensions];
    let distance = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(x, y)| f64::from((x - y) * (x - y))).sum::<f64>();
    for _ in 0..spec.restarts {
        let mut centroids = at((random() * count as f64) as usize).to_vec();
        while centroids.len() < spec.k * dimensions {
            let near: Vec<f64> = (0..count)
                .map(|i| centroids.chunks(dimensions).map(|c| distance(at(i), c)).fold(f64::INFINITY, f64::min))
                .collect();
            let mut left = random() * near.iter().sum::<f64>();
            let pick = near.iter().position(|&d| { left -= d; left <= 0.0 }).unwrap_or(0);
            centroids.extend_from_slice(at(pick));
        }
        let mut labels = vec![0u32; count];
        let mut inertia = 0.0;
        for _ in 0..spec.max_iterations {
            let mut changed = false;
            inertia = 0.0;
            for i in 0..count {
                let (label, d) = centroids.chunks(dimensions).map(|c| distance(at(i), c)).enumerate().fold((0, f64::INFINITY), |b, x| if x.1 < b.1 { x } else { b });
                changed |= labels[i] != label as u32;
                labels[i] = label as u32;
                inertia += d;
            }
            let mut sums = vec![0.0; centroids.len()];
            let mut counts = vec![0.0; spec.k];
            for i in 0..count {
                counts[labels[i] as usize] += 1.0;
                for (s, v) in sums[labels[i] as usize * dimensions..].iter_mut().zip(at(i)) { *s += f64::from(*v); }
            }
            for (j, c) in centroids.iter_mut().enumerate() {
                if counts[j / dimensions] > 0.0 { *c = (sums[j] / counts[j / dimensions]) as f32; }
            }
            if !changed { break; }
        }
        if best.as_ref().is_none_or(|b| inertia < b.inertia) { best = Some(KMeans { centroids, labels, inertia }); }
    }
    best.unwrap()
}
