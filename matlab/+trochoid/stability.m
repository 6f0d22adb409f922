function answer = stability(case_, varargin)
%STABILITY  Floquet multiplier, limit depth and stability lobe diagram: whether a small
%   vibration grows.
%
%   answer = trochoid.stability(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('stability', case_, varargin{:});
end
