function answer = modes(case_, varargin)
%MODES  Natural frequencies, modal masses, stiffnesses and damping ratios from a measured
%   frequency response function (FRF).
%
%   answer = trochoid.modes(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('modes', case_, varargin{:});
end
