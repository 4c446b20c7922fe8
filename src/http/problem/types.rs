//! The kinds of problems, each with its URI, status and title.

use axum::http::StatusCode;

macro_rules! problem_types {
    ($($(#[$doc:meta])* $name:ident = $slug:literal, $status:ident, $title:literal;)*) => {
        /// The kinds of problems: stable URIs for programs.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum ProblemType {
            $($(#[$doc])* $name,)*
        }

        impl ProblemType {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$name),*];

            /// Last part of the type's URI, status and title.
            const fn row(self) -> (&'static str, StatusCode, &'static str) {
                match self {
                    $(Self::$name => ($slug, StatusCode::$status, $title),)*
                }
            }
        }
    };
}

problem_types! {
    /// The request is not understood.
    BadRequest = "bad-request", BAD_REQUEST, "The request is malformed";
    /// A query parameter is unknown or wrong.
    BadParameter = "bad-parameter", BAD_REQUEST, "A parameter is unknown or has a bad value";
    /// No key was sent.
    KeyRequired = "key-required", UNAUTHORIZED, "The service needs a key";
    /// A key that opens nothing.
    InvalidKey = "invalid-key", UNAUTHORIZED, "The key opens nothing";
    /// The key is not good for this.
    MissingScope = "missing-scope", FORBIDDEN, "The key lacks a scope";
    /// A page of another site tried to write.
    CrossOrigin = "cross-origin-write", FORBIDDEN, "Pages of other sites may not write";
    /// The service has another name.
    Misdirected = "misdirected", MISDIRECTED_REQUEST, "The service does not answer under this host";
    /// The tenant has as much as it may.
    OverQuota = "over-quota", FORBIDDEN, "A quota of the tenant is reached";
    /// What is built in cannot be changed.
    ReadOnly = "read-only", FORBIDDEN, "The resource is read-only";
    /// Nothing is there.
    NotFound = "not-found", NOT_FOUND, "There is no such resource";
    /// A point lies outside the map.
    OutsideMap = "outside-map", NOT_FOUND, "The point lies outside the map";
    /// A route begins or ends outside the map.
    RouteOutside = "route-outside", NOT_FOUND, "No route: an end lies outside the map";
    /// A route begins or ends where robots may not drive.
    RouteNotDrivable = "route-not-drivable", NOT_FOUND, "No route: an end lies in a place that is not drivable";
    /// A route begins or ends on an obstacle.
    RouteBlocked = "route-blocked", NOT_FOUND, "No route: an end lies on a cell that is not free";
    /// The vehicle is too wide for an end or for every way.
    RouteTooNarrow = "route-too-narrow", NOT_FOUND, "No route: the vehicle is too wide";
    /// No vehicle of this width can stand before the storage location.
    RouteNoAccess = "route-no-access", NOT_FOUND, "No route: the vehicle cannot stand before the location";
    /// What the request blocks leaves no way.
    RouteCutOff = "route-cut-off", NOT_FOUND, "No route: the request blocks every way";
    /// No chain of drivable places.
    RouteDisconnected = "route-disconnected", NOT_FOUND, "No route: no drivable places join the ends";
    /// The method does not apply.
    MethodNotAllowed = "method-not-allowed", METHOD_NOT_ALLOWED, "The resource does not answer this method";
    /// No representation that the client accepts.
    NotAcceptable = "not-acceptable", NOT_ACCEPTABLE, "No representation of an accepted media type";
    /// The body arrived too slowly.
    Timeout = "request-timeout", REQUEST_TIMEOUT, "The request took too long to arrive";
    /// The state of the resource forbids it.
    Conflict = "conflict", CONFLICT, "The state of the resource forbids the request";
    /// Two maps that were to be of one site are not.
    NotSameSite = "not-same-site", CONFLICT, "The maps show different sites";
    /// The map is there, its analysis is not.
    NotAnalysed = "not-analysed", CONFLICT, "The map has no finished analysis yet";
    /// `If-Match` named another version.
    PreconditionFailed = "precondition-failed", PRECONDITION_FAILED, "The resource has changed";
    /// Over a limit.
    TooLarge = "too-large", PAYLOAD_TOO_LARGE, "The request is over a limit";
    /// Not a format that is read.
    UnsupportedMediaType = "unsupported-media-type", UNSUPPORTED_MEDIA_TYPE, "The format is not supported";
    /// Well formed, and wrong.
    Invalid = "invalid", UNPROCESSABLE_ENTITY, "The content is invalid";
    /// A write without `If-Match`.
    PreconditionRequired = "precondition-required", PRECONDITION_REQUIRED, "The write needs an If-Match header";
    /// The key asked too often, or its address sent many wrong ones.
    TooManyRequests = "too-many-requests", TOO_MANY_REQUESTS, "Too many requests";
    /// As many jobs of the tenant wait as may.
    TooManyJobs = "too-many-jobs", TOO_MANY_REQUESTS, "The tenant has too many jobs waiting";
    /// Something is wrong in the service.
    Internal = "internal", INTERNAL_SERVER_ERROR, "The service failed";
    /// A stored blob is not what was written.
    Damaged = "damaged", INTERNAL_SERVER_ERROR, "Stored data is damaged";
    /// The queue is full.
    Busy = "busy", SERVICE_UNAVAILABLE, "The queue is full";
    /// As many requests, uploads or streams as may be.
    Overloaded = "overloaded", SERVICE_UNAVAILABLE, "The service has as much to do as it can";
    /// The store does not answer, or the answer took too long.
    Unavailable = "unavailable", SERVICE_UNAVAILABLE, "The service cannot answer now";
    /// The disk is full.
    NoSpace = "no-space", INSUFFICIENT_STORAGE, "The server is short of disk space";
}

impl ProblemType {
    /// The relative URI that names the type.
    #[must_use]
    pub fn uri(self) -> String {
        format!("/problems/{}", self.row().0)
    }

    /// The kind with this last part of its URI.
    #[must_use]
    pub fn find(slug: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|kind| kind.row().0 == slug)
    }

    /// The kind, for people.
    #[must_use]
    pub const fn title(self) -> &'static str {
        self.row().2
    }

    /// The status that goes with it.
    #[must_use]
    pub const fn status(self) -> StatusCode {
        self.row().1
    }

    /// The type of a refusal that the framework made.
    pub(super) fn of_status(status: StatusCode) -> Self {
        match status {
            StatusCode::NOT_FOUND => Self::NotFound,
            StatusCode::METHOD_NOT_ALLOWED => Self::MethodNotAllowed,
            StatusCode::PAYLOAD_TOO_LARGE => Self::TooLarge,
            StatusCode::UNSUPPORTED_MEDIA_TYPE => Self::UnsupportedMediaType,
            status if status.is_client_error() => Self::BadRequest,
            _ => Self::Internal,
        }
    }
}
