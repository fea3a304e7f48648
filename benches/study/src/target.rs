//! What the program was compiled for: times mean little without it.

/// The processor and the switches of the compiler that a measurement depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target {
    /// The architecture, such as `x86_64`.
    pub architecture: &'static str,
    /// The operating system, such as `linux`.
    pub operating_system: &'static str,
    /// The instruction set extensions that the compiler was allowed to use. What the processor has
    /// besides stays unused.
    pub features: &'static [&'static str],
    /// Whether debug assertions are on: times are of no use then.
    pub debug: bool,
}

macro_rules! enabled {
    ($($feature:tt)*) => {
        &[$(#[cfg(target_feature = $feature)] $feature),*]
    };
}

impl Target {
    /// The target that this library was compiled for.
    pub const CURRENT: Self = Self {
        architecture: std::env::consts::ARCH,
        operating_system: std::env::consts::OS,
        features: enabled! {
            "sse2" "sse3" "ssse3" "sse4.1" "sse4.2" "avx" "avx2" "fma" "bmi1" "bmi2" "avx512f" "avx512dq" "avx512vl"
            "neon" "sve" "sve2" "v" "simd128" "relaxed-simd"
        },
        debug: cfg!(debug_assertions),
    };
}

impl std::fmt::Display for Target {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}, {}", self.architecture, self.operating_system)?;
        match self.features {
            [] => write!(f, ", no target features")?,
            features => write!(f, ", target features {}", features.join(" "))?,
        }
        if self.debug {
            write!(f, ", WITH DEBUG ASSERTIONS")
        } else {
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Target;

    #[test]
    fn features_are_those_of_the_compiler() {
        let listed = |name| Target::CURRENT.features.contains(&name);
        assert_eq!(listed("fma"), cfg!(target_feature = "fma"));
        assert_eq!(listed("sse2"), cfg!(target_feature = "sse2"));
        assert!(
            Target::CURRENT
                .to_string()
                .starts_with(std::env::consts::ARCH)
        );
    }
}
