function answer = plan(case_, varargin)
%PLAN  Which cut to measure next: the one that narrows cutting coefficients and runout
%   most; how to measure a wall, and how to cut it; which feed keeps a roughness.
%
%   answer = trochoid.plan(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('plan', case_, varargin{:});
end
